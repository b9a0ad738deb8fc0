// Files that are read, without what only files that are written need: a page has these alone.
#include <cerrno>
#include <cstring>

#include "base/error.h"
#include "base/file.h"

#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

namespace gonio {

InputFile::InputFile(std::string path) : path_(std::move(path)) {
  // The kind is asked before opening: opening a pipe would wait for its writer.
  struct stat s {};
  if (::stat(path_.c_str(), &s) != 0)
    throw bad_input(path_, "opening", std::strerror(errno), "a readable file");
  if (S_ISDIR(s.st_mode)) throw bad_input(path_, "opening", "a directory", "a file");
  if (!S_ISREG(s.st_mode)) throw bad_input(path_, "opening", "a device or pipe", "a regular file");
  if (s.st_size == 0) throw bad_input(path_, "byte 0", "an empty file", "data");
  file_.reset(std::fopen(path_.c_str(), "rb"));
  if (!file_) throw bad_input(path_, "opening", std::strerror(errno), "a readable file");
  opened_ = stamp();
  size_ = opened_.size;
  will_read(path_);
}

void expect_there(const std::string& path) {
  if (struct stat s{}; ::stat(path.c_str(), &s) != 0)
    throw bad_input(path, "opening", std::strerror(errno), "a readable file");
}

InputFile::Stamp InputFile::stamp() const {
  struct stat s {};
  if (::fstat(::fileno(file_.get()), &s) != 0)
    throw bad_input(path_, "reading", std::strerror(errno), "a readable file");
  return {static_cast<std::uint64_t>(s.st_size),
          static_cast<std::int64_t>(s.st_mtim.tv_sec) * 1'000'000'000 + s.st_mtim.tv_nsec,
          s.st_ino};
}

void InputFile::expect_unchanged() const {
  if (stamp() != opened_)
    throw bad_input(path_, "reading", "the file changed meanwhile", "one that stays as it is");
}

void InputFile::read_at(std::uint64_t offset, void* to, std::size_t n) const {
  std::size_t done = 0;
  while (done < n) {
    const auto got = ::pread(::fileno(file_.get()), static_cast<char*>(to) + done, n - done,
                             static_cast<off_t>(offset + done));
    if (got < 0 && errno == EINTR) continue;
    if (got < 0)
      throw bad_input(path_, fmt::format("byte {}", offset + done), std::strerror(errno),
                      "a readable file");
    if (got == 0)
      throw bad_input(path_, fmt::format("byte {}", offset + done), "the end of the file",
                      fmt::format("{} more bytes", n - done));
    done += static_cast<std::size_t>(got);
  }
}

void InputFile::read(void* to, std::size_t n) {
  const std::size_t got = std::fread(to, 1, n, file_.get());
  if (got != n)
    throw bad_input(path_, fmt::format("byte {}", position_ + got), "the end of the file",
                    fmt::format("{} more bytes", n - got));
  position_ += n;
}

std::string InputFile::peek(std::size_t n) {
  std::string bytes(n, '\0');
  bytes.resize(std::fread(bytes.data(), 1, n, file_.get()));
  if (std::fseek(file_.get(), static_cast<long>(position_), SEEK_SET) != 0)
    throw bad_input(path_, fmt::format("byte {}", position_), std::strerror(errno), "a seek");
  return bytes;
}

void InputFile::expect_at_most(std::uint64_t most) const {
  if (size_ > most)
    throw bad_input(path_, "size", fmt::format("{} bytes", size_), fmt::format("at most {}", most));
}

std::size_t InputFile::left(std::uint64_t most) const {
  const std::uint64_t n = size_ > position_ ? size_ - position_ : 0;
  if (n > most)
    throw bad_input(path_, fmt::format("byte {}", position_), fmt::format("{} bytes", n),
                    fmt::format("at most {}", most));
  return static_cast<std::size_t>(n);
}

std::string InputFile::read_rest(std::uint64_t most) {
  std::string bytes(left(most), '\0');
  read(bytes.data(), bytes.size());
  return bytes;
}

}  // namespace gonio
