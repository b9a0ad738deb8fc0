#pragma once
/// \file
/// Files in, files out: a reader that says where a file ends too early, and a writer that leaves
/// either the whole file or none.

#include <cstdint>
#include <cstdio>
#include <memory>
#include <span>
#include <string>
#include <string_view>

namespace gonio {

/// A regular file opened for reading.  Every failure is Error(bad_input) with the place.
class InputFile {
 public:
  explicit InputFile(std::string path);
  const std::string& path() const { return path_; }
  std::uint64_t size() const { return size_; }
  std::uint64_t position() const { return position_; }

  /// Reads exactly n bytes; a file that is shorter is an error naming the byte where it ends.
  void read(void* to, std::size_t n);
  /// The next bytes, at most n, without moving on.
  std::string peek(std::size_t n);
  /// Reads exactly n bytes at an offset, wherever the position is; from any thread.
  void read_at(std::uint64_t offset, void* to, std::size_t n) const;
  /// Fails if the file was written to, or became another, since it was opened: what was read of it may
  /// be a mixture.
  void expect_unchanged() const;
  /// Number of bytes left; refuses more than `most`.
  std::size_t left(std::uint64_t most) const;
  /// The rest of the file; refuses more than `most` bytes.
  std::string read_rest(std::uint64_t most = std::uint64_t{1} << 31);

 private:
  struct Close {
    void operator()(std::FILE* f) const { std::fclose(f); }
  };
  /// Size and time [ns] of a file, which change when it is written to.
  struct Stamp {
    std::uint64_t size = 0;
    std::int64_t written = 0;
    bool operator==(const Stamp&) const = default;
  };
  Stamp stamp() const;

  std::string path_;
  std::unique_ptr<std::FILE, Close> file_;
  std::uint64_t size_ = 0, position_ = 0;
  Stamp opened_;
};

/// Fails as reading would where there is no file, nor folder, of that path.
void expect_there(const std::string& path);

/// A file being made under a temporary name beside its own; it appears under its own name when
/// commit() has succeeded and leaves nothing behind otherwise.  A link is followed, not replaced;
/// a directory, device or pipe is refused.
class OutputFile {
 public:
  explicit OutputFile(std::string path);
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  const std::string& path() const { return path_; }
  /// For libraries that write by name.
  const std::string& temporary_path() const { return temporary_; }
  void write(std::string_view bytes);
  /// Writes at an offset, past what write() wrote and beside it.  One that fails keeps the file from being committed, too: for
  /// libraries that lose errors.
  void write_at(std::uint64_t offset, std::string_view bytes);
  /// Flushes; what is left to fail in commit() is the renaming.
  void close();
  /// Closes and renames.
  void commit();

 private:
  [[noreturn]] void fail(const std::string& doing) const;
  std::string path_, target_, temporary_;  ///< target_: path_ after its links
  std::FILE* file_ = nullptr;
  bool committed_ = false;
  int lost_ = 0;  ///< why a write_at() failed; 0: none did
};

/// From now on an interrupt, hang-up or termination takes the files being made with it.
void remove_unfinished_files_on_signals();

/// All are whole before the first takes its name.
/// \param files  nullptr: none
void commit_all(std::span<OutputFile* const> files);

/// The whole of a small file at once.
void write_file(const std::string& path, std::string_view bytes);

}  // namespace gonio
