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
  /// What changes when a file is written to, or becomes another: size, time [ns] and number.
  struct Stamp {
    std::uint64_t size = 0;
    std::int64_t written = 0;
    std::uint64_t number = 0;
    bool operator==(const Stamp&) const = default;
  };

  explicit InputFile(std::string path);
  Stamp stamp() const;
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
  /// Refuses a file of more bytes.
  void expect_at_most(std::uint64_t most) const;
  /// Number of bytes left; refuses more than `most`.
  std::size_t left(std::uint64_t most) const;
  /// The rest of the file; refuses more than `most` bytes.
  std::string read_rest(std::uint64_t most = std::uint64_t{1} << 31);

 private:
  struct Close {
    void operator()(std::FILE* f) const { std::fclose(f); }
  };
  std::string path_;
  std::unique_ptr<std::FILE, Close> file_;
  std::uint64_t size_ = 0, position_ = 0;
  Stamp opened_;
};

/// Fails as reading would where there is no file, nor folder, of that path.
void expect_there(const std::string& path);

/// Who chose the name of a file to write, and with it what becomes of a link there.
enum class NamedBy {
  user,  ///< a link is followed, as by any other program
  gonio  ///< beside a file, or in a folder, that may be a stranger's: a link is replaced, for it
         ///< may lead to any file of the user's
};

/// While one of these lives, no file that is read is replaced by one that is written, and no two that are written have one name,
/// whatever links lead to it: an InputFile of a name that an OutputFile has, or the other way round, throws NameTaken.  The program
/// has one for its whole run; of two at a time the later does nothing.
class FileGuard {
 public:
  FileGuard();
  ~FileGuard();
  FileGuard(const FileGuard&) = delete;
  FileGuard& operator=(const FileGuard&) = delete;

 private:
  bool guards_;
};
/// Names a file that is not read yet as one that is.
void will_read(const std::string& path);
/// Names an earlier result: the run may read it and then replace it.
void may_replace(const std::string& path);
/// Refuses, as NameTaken, a name to write that a file has that is read.
void expect_no_input(const std::string& path, NamedBy by = NamedBy::user);
/// True where both are one name in one folder, behind their links.
bool same_place(const std::string& a, const std::string& b);

/// Path of a file that a document names, which lies below the document's folder, behind all links, too.  One that does not is refused
/// unless follow_paths() was called: a document of a stranger shall not have other files read.
std::string path_beside(const std::string& document, const std::string& name);
/// Allows documents to name any file.
void follow_paths();

/// A file being made under a temporary name beside its own; it appears under its own name when
/// commit() has succeeded and leaves nothing behind otherwise.  A directory, device or pipe is refused.
class OutputFile {
 public:
  explicit OutputFile(std::string path, NamedBy by = NamedBy::user);
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  const std::string& path() const { return path_; }
  /// Folder that it appears in, behind its links.
  std::string folder() const;
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
  void release();
  std::string path_, target_,
      temporary_;  ///< target_: path_, after its links where they are followed
  NamedBy by_;
  std::FILE* file_ = nullptr;
  bool committed_ = false, claimed_ = false;  ///< claimed_: the name is this file's (FileGuard)
  int lost_ = 0;                              ///< why a write_at() failed; 0: none did
};

/// A folder that no other process locks meanwhile, where its file system has locks.  Who does not wait makes it where it lacks (make_folder).
class FolderLock {
 public:
  enum class Taken { waits, is_refused };
  /// \param taken  what happens where another process has it
  FolderLock(const std::string& folder, Taken taken);
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;
  int descriptor() const { return folder_; }

 private:
  int folder_ = -1;
};

/// From now on an interrupt, hang-up or termination takes the files being made, and the programs run, with it.  One that is ignored, as
/// nohup does, stays so.
void remove_unfinished_files_on_signals();

/// All are whole before the first takes its name, and no other run's take theirs in between: of two runs with the same outputs all are
/// of the later.  (Where a folder cannot be locked within two seconds, they go on without.)
/// \param files  nullptr: none
/// \param held  the lock of a folder that this run has; nullptr: none
void commit_all(std::span<OutputFile* const> files, const FolderLock* held = nullptr);

/// The whole of a small file at once.
void write_file(const std::string& path, std::string_view bytes, NamedBy by = NamedBy::user);

/// Makes a folder, where it is not there, whose name gonio chose.  A link is refused: what gonio puts there, and takes away, lies in
/// a folder of its own.
/// \return whether it was made
bool make_folder(const std::string& path);

}  // namespace gonio
