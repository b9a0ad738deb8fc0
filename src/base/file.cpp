#include "base/file.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cctype>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <ctime>
#include <deque>
#include <filesystem>
#include <map>
#include <mutex>
#include <optional>
#include <set>
#include <thread>
#include <utility>
#include <vector>

#include "base/earlier_file.h"
#include "base/error.h"
#include "base/numbers.h"
#include "base/process.h"
#include "base/text.h"

#include <dirent.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

namespace gonio {
namespace {

/// A path and those that it leads to through links, to the one that is none; nothing need be there yet.  Of a circle of links some.
std::vector<std::filesystem::path> along_links(std::filesystem::path path) {
  std::vector<std::filesystem::path> all{std::move(path)};
  std::error_code none_there;
  constexpr std::size_t most = 40;  // as the system follows
  while (all.size() <= most && std::filesystem::is_symlink(all.back(), none_there))
    all.push_back(all.back().parent_path() / std::filesystem::read_symlink(all.back(), none_there));
  return all;
}

std::filesystem::path folder_of(const std::filesystem::path& file) {
  const auto folder = file.parent_path();
  return folder.empty() ? "." : folder;
}

/// Name in a folder, which is known by its numbers; of a folder that is not there yet by its path.
struct Entry {
  dev_t device = 0;
  ino_t folder = 0;
  std::string name;
  auto operator<=>(const Entry&) const = default;
};
Entry entry_of(const std::filesystem::path& at) {
  std::error_code none;
  if (struct stat s{}; ::stat(folder_of(at).c_str(), &s) == 0)
    return {s.st_dev, s.st_ino, at.filename().string()};
  return {0, 0,
          std::filesystem::weakly_canonical(std::filesystem::absolute(at, none), none).string()};
}

using EntryList = std::vector<Entry>;
/// Names that are taken by whoever opens a path: of the links that it leads through, too.  A name of gonio's own is never followed.
EntryList entries_of(const std::string& path, NamedBy by = NamedBy::user) {
  if (by == NamedBy::gonio) return {entry_of(path)};
  EntryList all;
  for (const auto& at : along_links(path)) all.push_back(entry_of(at));
  return all;
}
bool any_in(const std::set<Entry>& names, const EntryList& entries) {
  return std::ranges::any_of(entries, [&](const Entry& e) { return names.contains(e); });
}

/// Files that the run reads and those that it is writing, while a FileGuard lives.
struct Guarded {
  std::set<Entry> inputs, outputs, replaceable;
};
std::mutex guarding;
std::optional<Guarded> guarded;

/// act(files), where a FileGuard lives.
template <class Act>
void with_guarded(const Act& act) {
  const std::lock_guard lock(guarding);
  if (guarded) act(*guarded);
}
NameTaken overwritten(const std::string& path) {
  return NameTaken(fmt::format("{} is an input; it would be overwritten", path));
}

bool follows_paths = false;

}  // namespace

FileGuard::FileGuard() {
  const std::lock_guard lock(guarding);
  guards_ = !guarded;
  if (guards_) guarded.emplace();
}
FileGuard::~FileGuard() {
  const std::lock_guard lock(guarding);
  if (guards_) guarded.reset();
}

void will_read(const std::string& path) {
  with_guarded([&](Guarded& g) {
    const auto names = entries_of(path);
    if (g.replaceable.contains(names.front())) return;
    if (any_in(g.outputs, names)) throw overwritten(path);
    g.inputs.insert(names.begin(), names.end());
  });
}
void may_replace(const std::string& path) {
  with_guarded([&](Guarded& g) { g.replaceable.insert(entry_of(path)); });
}
void expect_no_input(const std::string& path, NamedBy by) {
  with_guarded([&](Guarded& g) {
    if (any_in(g.inputs, entries_of(path, by))) throw overwritten(path);
  });
}
bool remove_unless_input(const std::string& path) {
  bool is_input = false;
  with_guarded([&](Guarded& g) { is_input = g.inputs.contains(entry_of(path)); });
  if (!is_input) ::unlink(path.c_str());
  return !is_input;
}
bool make_folder(const std::string& path) {
  if (struct stat s{}; ::lstat(path.c_str(), &s) == 0 && S_ISLNK(s.st_mode))
    throw bad_input(path, "writing", "a link",
                    "a folder of gonio's own, or none (remove the link)");
  std::error_code failed;
  const bool made = std::filesystem::create_directories(path, failed);
  if (failed && !std::filesystem::is_directory(path))
    throw bad_input(path, "writing", failed.message(), "a folder that can be written");
  return made;
}
bool same_place(const std::string& a, const std::string& b) {
  return entries_of(a).back() == entries_of(b).back();
}

void follow_paths() {
  follows_paths = true;
}
std::string path_beside(const std::string& document, const std::string& name) {
  namespace fs = std::filesystem;
  const fs::path folder = folder_of(document), path = fs::path(document).parent_path() / name;
  if (follows_paths) return path.string();
  std::error_code unknown;  // what cannot be looked up cannot be opened either
  const auto place = [&](const fs::path& p) {
    return fs::weakly_canonical(fs::absolute(p, unknown), unknown);
  };
  const auto below = place(path).lexically_relative(place(folder));
  if (!unknown && (below.empty() || *below.begin() == ".."))
    throw bad_input(document, "a path", name,
                    "a file below the document's folder, or --follow-paths");
  return path.string();
}

namespace {

/// Names of the files being made, for the signal handler, which may only read, unlink and kill.
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
    end_programs();
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
  for (const int signal : {SIGINT, SIGTERM, SIGHUP})
    if (std::signal(signal, remove_unfinished) == SIG_IGN) std::signal(signal, SIG_IGN);
}

namespace {

/// Text of one of the system's small files; "" if it cannot be read.
std::string system_text(const std::string& path) {
  std::string text(4096, '\0');
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  const auto n = descriptor < 0 ? -1 : ::read(descriptor, text.data(), text.size());
  if (descriptor >= 0) ::close(descriptor);
  text.resize(n < 0 ? 0 : static_cast<std::size_t>(n));
  return text;
}

/// What the system tells of a process after its name, from its state on; nothing if it cannot be told.
std::vector<std::string> told_of(const std::string& process) {
  const std::string stat = system_text("/proc/" + process + "/stat");
  const auto name_ends = stat.rfind(") ");  // a name may hold blanks and ')'
  if (name_ends == std::string::npos) return {};
  return split(std::string_view(stat).substr(name_ends + 2), ' ');
}

/// Time at which a process was started; "" if it cannot be told.
std::string start_of(const std::string& process) {
  const auto told = told_of(process);
  constexpr std::size_t start = 19;  // the 22nd of all, which the state is third of
  return told.size() > start ? told[start] : "";
}

/// True of a process that has ended, whether or not anybody waits for it: in containers often nobody does.
bool has_ended(const std::string& process) {
  const auto told = told_of(process);
  return !told.empty() && told[0] == "Z";
}

/// Boot and namespace of process numbers, within which a number and the start of its process name it; "" where the system does
/// not tell them.
const std::string& home() {
  static const std::string mine = [] {
    std::string boot = system_text("/proc/sys/kernel/random/boot_id");
    std::erase_if(boot, [](char c) { return !std::isxdigit(static_cast<unsigned char>(c)); });
    struct stat numbers {};
    if (boot.empty() || start_of("self").empty() || ::stat("/proc/self/ns/pid", &numbers) != 0)
      return std::string();
    return fmt::format("{}-{}", boot, numbers.st_ino);
  }();
  return mine;
}

constexpr std::string_view kPrefix = ".gonio.", kSuffix = ".tmp";

/// Name of a temporary file: of its maker, not of what it is to become, whose own may be as long as names can be.
std::string temporary_name(unsigned counter) {
  // Asked each time: a child of fork() is another process.
  const std::string start = home().empty() ? "" : start_of("self");
  return fmt::format("{}{}.{}.{}.{}{}", kPrefix, home().empty() ? "-" : home(), ::getpid(),
                     start.empty() ? "-" : start, counter, kSuffix);
}

/// True for a temporary file of a process of this boot that has ended.  Those of other machines that share
/// the folder, and of other namespaces, whose processes cannot be seen from here, are left alone.
bool is_left_over(std::string_view name) {
  if (!name.starts_with(kPrefix) || !name.ends_with(kSuffix)) return false;
  const auto parts =
      split(name.substr(kPrefix.size(), name.size() - kPrefix.size() - kSuffix.size()), '.');
  if (parts.size() != 4 || home().empty() || parts[0] != home()) return false;
  const auto process = number_from<pid_t>(parts[1]);
  if (!process || *process <= 0) return false;
  if ((::kill(*process, 0) != 0 && errno == ESRCH) || has_ended(parts[1])) return true;
  const auto start = start_of(parts[1]);
  return !start.empty() && start != parts[2];
}

/// Removes what killed runs left in a folder; looks into each folder once.
void remove_left_over(const std::filesystem::path& folder) {
  static std::mutex one_at_a_time;
  static std::set<std::filesystem::path> seen;
  {
    const std::lock_guard lock(one_at_a_time);
    if (!seen.insert(folder).second) return;
  }
  DIR* const open = ::opendir(folder.c_str());
  if (!open) return;
  while (const auto* entry = ::readdir(open))
    if (is_left_over(entry->d_name)) ::unlinkat(::dirfd(open), entry->d_name, 0);
  ::closedir(open);
}

/// Gives a file the owner and the rights of the one that it is to replace.  Where the group cannot be kept, the
/// new one may do what all others may.
void make_like(const struct stat& old, int file) {
  mode_t mode = old.st_mode & 0777;
  if (::fchown(file, old.st_uid, old.st_gid) != 0 &&
      ::fchown(file, static_cast<uid_t>(-1), old.st_gid) != 0)
    mode = (mode & 0707) | (mode & 0007) << 3;
  static_cast<void>(::fchmod(file, mode));  // not every file system has rights
}

/// Folders in which files took their names: each is on the disk at once, but once a second where they are many, and
/// the rest at the end of the program.
class RenamedIn {
 public:
  ~RenamedIn() {
    for (const auto& [folder, state] : folders_)
      if (state.waits) sync(folder);
  }
  void operator()(const std::filesystem::path& folder) {
    const auto now = std::chrono::steady_clock::now();
    {
      const std::lock_guard lock(one_at_a_time_);
      State& state = folders_[folder];
      state.waits = state.synced && now < *state.synced + std::chrono::seconds(1);
      if (state.waits) return;
      state.synced = now;
    }
    sync(folder);
  }

 private:
  struct State {
    std::optional<std::chrono::steady_clock::time_point> synced;
    bool waits = false;
  };
  /// Not every file system can say so: no failure of the file.
  static void sync(const std::filesystem::path& folder) {
    const int descriptor = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (descriptor < 0) return;
    static_cast<void>(::fsync(descriptor));
    ::close(descriptor);
  }
  std::mutex one_at_a_time_;
  std::map<std::filesystem::path, State> folders_;
};

void sync_folder(const std::filesystem::path& folder) {
  static RenamedIn renamed_in;
  renamed_in(folder);
}

}  // namespace

OutputFile::OutputFile(std::string path, NamedBy by) : path_(std::move(path)), by_(by) {
  if (path_.empty()) throw bad_input("''", "writing", "no name", "the name of a file");
  struct stat old {};
  const bool is_mine = by == NamedBy::gonio;
  bool replaces = (is_mine ? ::lstat(path_.c_str(), &old) : ::stat(path_.c_str(), &old)) == 0;
  if (replaces) {
    if (S_ISDIR(old.st_mode))
      throw bad_input(path_, "writing", "a directory", "the name of a file");
    if (S_ISLNK(old.st_mode))
      replaces = false;  // whose rights are nobody's
    else if (!S_ISREG(old.st_mode))
      throw bad_input(path_, "writing", "a device or pipe", "the name of a file");
  } else if (errno != ENOENT) {
    fail("writing");
  }
  with_guarded([&](Guarded& g) {
    const auto names = entries_of(path_, by_);
    if (any_in(g.inputs, names)) throw overwritten(path_);
    if (any_in(g.outputs, names))
      throw NameTaken(fmt::format("{} is named for two outputs", path_));
  });
  target_ = is_mine ? path_ : along_links(path_).back().string();
  const auto folder = folder_of(target_);
  remove_left_over(folder);
  static std::atomic<unsigned> counter = 0;
  int descriptor = -1;
  do {
    leave(temporary_.c_str());
    temporary_ = (folder / temporary_name(counter++)).string();
    enter(temporary_.c_str());  // before it is there: a signal may come in between
    while (ending) ::pause();
    descriptor =
        ::open(temporary_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, replaces ? 0600 : 0666);
  } while (descriptor < 0 && errno == EEXIST);
  if (descriptor < 0) {
    leave(temporary_.c_str());
    fail("writing");
  }
  if (replaces) make_like(old, descriptor);
  file_ = ::fdopen(descriptor, "wb");
  if (!file_) {
    ::close(descriptor);
    std::remove(temporary_.c_str());
    leave(temporary_.c_str());
    fail("writing");
  }
  with_guarded([&](Guarded& g) {
    const auto names = entries_of(path_, by_);
    if (any_in(g.outputs, names)) return;
    g.outputs.insert(names.begin(), names.end());
    claimed_ = true;
  });
}

OutputFile::~OutputFile() {
  if (file_) std::fclose(file_);
  if (!committed_) std::remove(temporary_.c_str());
  release();
  leave(temporary_.c_str());
}

void OutputFile::release() {
  if (std::exchange(claimed_, false))
    with_guarded([&](Guarded& g) {
      for (const auto& name : entries_of(path_, by_)) g.outputs.erase(name);
    });
}

void OutputFile::fail(const std::string& doing) const {
  throw bad_input(path_, doing, std::strerror(errno), "a place that can be written");
}

void OutputFile::write(std::string_view bytes) {
  if (std::fwrite(bytes.data(), 1, bytes.size(), file_) != bytes.size()) fail("writing");
}

void OutputFile::write_at(std::uint64_t offset, std::string_view bytes) {
  while (!bytes.empty()) {
    const auto n =
        ::pwrite(::fileno(file_), bytes.data(), bytes.size(), static_cast<off_t>(offset));
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) {
      lost_ = n < 0 ? errno : ENOSPC;
      fail("writing");
    }
    bytes.remove_prefix(static_cast<std::size_t>(n));
    offset += static_cast<std::uint64_t>(n);
  }
}

void OutputFile::close() {
  if (!file_) return;
  if (lost_ != 0) {
    errno = lost_;
    fail("writing");
  }
  // On the disk before it takes its name: after a loss of power there is the old file or the new
  // one.
  const bool synced =
      std::fflush(file_) == 0 && (::fdatasync(::fileno(file_)) == 0 || errno == EINVAL);
  const int why = errno;
  const bool closed = std::fclose(file_) == 0;
  file_ = nullptr;
  if (!synced) errno = why;
  if (!synced || !closed) fail("writing");
}

std::string OutputFile::folder() const {
  return folder_of(target_).string();
}

void OutputFile::commit() {
  close();
  if (std::rename(temporary_.c_str(), target_.c_str()) != 0) fail("renaming");
  committed_ = true;
  release();
  sync_folder(folder_of(target_));
}

FolderLock::FolderLock(const std::string& folder, Taken taken) {
  for (;;) {
    if (taken == Taken::is_refused) make_folder(folder);
    folder_ = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (folder_ < 0)
      throw bad_input(folder, taken == Taken::waits ? "opening" : "writing", std::strerror(errno),
                      "a folder that can be written");
    const int how = LOCK_EX | (taken == Taken::is_refused ? LOCK_NB : 0);
    int locked = 0;
    while ((locked = ::flock(folder_, how)) != 0 && errno == EINTR) {
    }
    const bool others = locked != 0 && errno == EWOULDBLOCK;
    struct stat mine {
    }, there{};
    if (!others && ::fstat(folder_, &mine) == 0 && ::stat(folder.c_str(), &there) == 0 &&
        mine.st_ino == there.st_ino)
      return;
    ::close(folder_);  // who had it may have taken it away
    if (others)
      throw bad_input(folder, "writing", "another run of gonio at work there", "one at a time");
  }
}
FolderLock::~FolderLock() {
  ::close(folder_);
}

namespace {

/// Turn of one run to rename files in a folder.
class Turn {
 public:
  explicit Turn(const std::string& folder)
      : folder_(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)) {
    using namespace std::chrono_literals;
    for (auto waited = 0ms; waited < 2s && ::flock(folder_, LOCK_EX | LOCK_NB) != 0 &&
                            (errno == EWOULDBLOCK || errno == EINTR);
         waited += 5ms)
      std::this_thread::sleep_for(5ms);
  }
  ~Turn() {
    if (folder_ >= 0) ::close(folder_);
  }
  Turn(const Turn&) = delete;
  Turn& operator=(const Turn&) = delete;

 private:
  int folder_;
};

}  // namespace

void commit_all(std::span<OutputFile* const> files, const FolderLock* held) {
  // Each folder once, by its numbers, and in one order for all runs: none waits for one that waits.
  std::map<std::pair<dev_t, ino_t>, std::string> folders;
  for (auto* f : files)
    if (f) {
      f->close();
      if (struct stat s{}; ::stat(f->folder().c_str(), &s) == 0)
        folders.emplace(std::pair{s.st_dev, s.st_ino}, f->folder());
    }
  // Another descriptor would wait for the lock that this run has.
  if (struct stat s{}; held && ::fstat(held->descriptor(), &s) == 0)
    folders.erase({s.st_dev, s.st_ino});
  std::deque<Turn> turns;
  for (const auto& [numbers, folder] : folders) turns.emplace_back(folder);
  for (auto* f : files)
    if (f) f->commit();
}

void write_file(const std::string& path, std::string_view bytes, NamedBy by) {
  OutputFile out(path, by);
  out.write(bytes);
  out.commit();
}

}  // namespace gonio
