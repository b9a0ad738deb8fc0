#include "base/file.h"

#include <array>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <ctime>
#include <filesystem>

#include "base/error.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

namespace gonio {
namespace {

/// What a path leads to; that need not be there yet.  \param path  not a circle of links
std::filesystem::path behind_links(std::filesystem::path path) {
  std::error_code none_there;
  while (std::filesystem::is_symlink(path, none_there))
    path = path.parent_path() / std::filesystem::read_symlink(path);
  return path;
}

}  // namespace

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
}

InputFile::Stamp InputFile::stamp() const {
  struct stat s {};
  if (::fstat(::fileno(file_.get()), &s) != 0)
    throw bad_input(path_, "reading", std::strerror(errno), "a readable file");
  return {static_cast<std::uint64_t>(s.st_size),
          static_cast<std::int64_t>(s.st_mtim.tv_sec) * 1'000'000'000 + s.st_mtim.tv_nsec};
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

std::string InputFile::read_rest(std::uint64_t most) {
  const std::uint64_t n = size_ > position_ ? size_ - position_ : 0;
  if (n > most)
    throw bad_input(path_, fmt::format("byte {}", position_), fmt::format("{} bytes", n),
                    fmt::format("at most {}", most));
  std::string bytes(static_cast<std::size_t>(n), '\0');
  read(bytes.data(), bytes.size());
  return bytes;
}

namespace {

/// The names of the files being made, for the signal handler, which may only read and unlink.
std::array<std::atomic<const char*>, 4096> unfinished;
std::atomic<bool> ending = false;  ///< a signal came: no file is begun any more

void enter(const char* name) {
  for (auto& slot : unfinished) {
    const char* empty = nullptr;
    if (slot.compare_exchange_strong(empty, name)) return;
  }
}
void leave(const char* name) {
  for (auto& slot : unfinished) {
    const char* there = name;
    if (slot.compare_exchange_strong(there, nullptr)) return;
  }
}
void remove_unfinished(int signal) {
  ending = true;
  for (int round = 0; round < 2; ++round) {
    for (auto& slot : unfinished)
      if (const char* name = slot.load()) ::unlink(name);
    const timespec for_who_was_opening{0, 10'000'000};
    if (round == 0) ::nanosleep(&for_who_was_opening, nullptr);
  }
  std::signal(signal, SIG_DFL);
  std::raise(signal);
}

}  // namespace

void remove_unfinished_files_on_signals() {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) std::signal(signal, remove_unfinished);
}

OutputFile::OutputFile(std::string path) : path_(std::move(path)) {
  struct stat s {};
  if (::stat(path_.c_str(), &s) == 0) {
    if (S_ISDIR(s.st_mode)) throw bad_input(path_, "writing", "a directory", "the name of a file");
    if (!S_ISREG(s.st_mode))
      throw bad_input(path_, "writing", "a device or pipe", "the name of a file");
  } else if (errno != ENOENT) {
    fail("writing");
  }
  const auto target = behind_links(path_);
  target_ = target.string();
  static std::atomic<unsigned> counter = 0;
  int descriptor = -1;
  do {
    leave(temporary_.c_str());
    temporary_ = (target.parent_path() /
                  fmt::format(".{}.{}.{}.tmp", target.filename().string(), ::getpid(), counter++))
                     .string();
    enter(temporary_.c_str());  // before it is there: a signal may come in between
    while (ending) ::pause();
    descriptor = ::open(temporary_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  } while (descriptor < 0 && errno == EEXIST);
  if (descriptor < 0) {
    leave(temporary_.c_str());
    fail("writing");
  }
  file_ = ::fdopen(descriptor, "wb");
  if (!file_) {
    ::close(descriptor);
    std::remove(temporary_.c_str());
    leave(temporary_.c_str());
    fail("writing");
  }
}

OutputFile::~OutputFile() {
  if (file_) std::fclose(file_);
  if (!committed_) std::remove(temporary_.c_str());
  leave(temporary_.c_str());
}

void OutputFile::fail(const std::string& doing) const {
  throw bad_input(path_, doing, std::strerror(errno), "a place that can be written");
}

void OutputFile::write(std::string_view bytes) {
  if (std::fwrite(bytes.data(), 1, bytes.size(), file_) != bytes.size()) fail("writing");
}

void OutputFile::close() {
  if (!file_) return;
  const bool closed = std::fclose(file_) == 0;
  file_ = nullptr;
  if (!closed) fail("writing");
}

void OutputFile::commit() {
  close();
  if (std::rename(temporary_.c_str(), target_.c_str()) != 0) fail("renaming");
  committed_ = true;
}

void commit_all(std::span<OutputFile* const> files) {
  for (auto* f : files)
    if (f) f->close();
  for (auto* f : files)
    if (f) f->commit();
}

void write_file(const std::string& path, std::string_view bytes) {
  OutputFile out(path);
  out.write(bytes);
  out.commit();
}

}  // namespace gonio
