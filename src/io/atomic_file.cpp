#include "io/atomic_file.h"

#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <string>
#include <system_error>
#include <utility>

#include "tetsoup/error.h"
#include "tetsoup/io.h"

namespace tetsoup {

namespace fs = std::filesystem;

namespace {

constexpr int kMaxLinks = 40;        // As Linux follows.
constexpr int kMaxNameTries = 1000;  // Leftovers of killed processes that had our process number.

std::string reason_of(int error) {
  return std::error_code(error, std::generic_category()).message();
}

// Not in the target's own name, which may be as long as the file system allows already.
fs::path unused_name_beside(const fs::path& target, const char* ending) {
  static std::atomic<unsigned> counter{0};
  return target.parent_path() /
         (".tetsoup-" + std::to_string(::getpid()) + "-" + std::to_string(counter.fetch_add(1)) + ending);
}

// /dev/stdout leads through /proc to whatever the shell opened, be it a file: that must be written to, not replaced.
bool is_open_descriptor(const fs::path& link) {
  return link.native().starts_with("/proc/") || link.native().starts_with("/dev/fd/");
}

}  // namespace

AtomicFile::AtomicFile(const fs::path& path) : path_(path), target_(path) {
  std::error_code error;
  for (int links = 0; fs::is_symlink(fs::symlink_status(target_, error)); ++links) {
    if (links == kMaxLinks) fail(reason_of(ELOOP));
    if (is_open_descriptor(target_)) {
      open_directly();
      return;
    }
    const fs::path next = fs::read_symlink(target_, error);
    if (error) fail(error.message());
    target_ = target_.parent_path() / next;
  }
  const fs::file_status status = fs::status(target_, error);
  if (fs::is_directory(status)) fail("it is a folder");
  existed_ = fs::exists(status);
  if (existed_ && !fs::is_regular_file(status)) {
    open_directly();
    return;
  }
  if (existed_ && ::access(target_.c_str(), W_OK) != 0) fail_with_errno();
  open_temporary();
  if (existed_) fs::permissions(temporary_, status.permissions(), error);
}

AtomicFile::AtomicFile(AtomicFile&& other) noexcept
    : path_(std::move(other.path_)),
      target_(std::move(other.target_)),
      temporary_(std::exchange(other.temporary_, {})),
      replaced_(std::exchange(other.replaced_, {})),
      existed_(other.existed_),
      file_(std::move(other.file_)) {}

AtomicFile::~AtomicFile() {
  file_.reset();
  std::error_code ignored;
  if (!temporary_.empty()) fs::remove(temporary_, ignored);
}

void AtomicFile::open_temporary() {
  for (int tries = 0; tries < kMaxNameTries; ++tries) {
    fs::path name = unused_name_beside(target_, ".tmp");
    errno = 0;
    file_.reset(std::fopen(name.c_str(), "wbx"));
    if (file_) {
      temporary_ = std::move(name);  // A copy could run out of memory, and leave the file.
      return;
    }
    if (errno != EEXIST) break;
  }
  const int reason = errno;
  const fs::path folder = target_.parent_path().empty() ? fs::path(".") : target_.parent_path();
  std::error_code error;
  if (!fs::exists(folder, error)) fail("the folder '" + folder.string() + "' does not exist");
  errno = reason;
  fail_with_errno();
}

// Appending, so that output which the shell already sent to the same file is not overwritten.
void AtomicFile::open_directly() {
  file_.reset(std::fopen(path_.c_str(), "ab"));
  if (!file_) fail_with_errno();
}

void AtomicFile::write(std::string_view text) {
  if (text.empty()) return;  // Its address may be null, which fwrite does not take.
  if (std::fwrite(text.data(), 1, text.size(), file_.get()) != text.size()) fail_with_errno();
}

void AtomicFile::write(std::span<const std::byte> bytes) {
  write(std::string_view(reinterpret_cast<const char*>(bytes.data()), bytes.size()));
}

void AtomicFile::commit() {
  commit_together({this, 1});
}

void AtomicFile::commit_together(std::span<AtomicFile> files) {
  for (AtomicFile& file : files) file.close();
  std::size_t named = 0;
  try {
    for (; named < files.size(); ++named) {
      if (files.size() > 1) files[named].keep_replaced_file();
      files[named].take_name();
    }
  } catch (...) {
    if (named < files.size()) files[named].forget_replaced_file();
    while (named > 0) files[--named].give_name_back();
    throw;
  }
  for (AtomicFile& file : files) file.forget_replaced_file();
}

void AtomicFile::close() {
  if (std::fflush(file_.get()) != 0) fail_with_errno();
  if (!temporary_.empty()) bring_to_disk();
  if (std::fclose(file_.release()) != 0) fail_with_errno();
}

// Else a power cut may keep the new name and lose what was written. Not every file system can tell.
void AtomicFile::bring_to_disk() {
  if (::fsync(::fileno(file_.get())) != 0 && errno != EINVAL && errno != ENOTSUP && errno != ENOSYS) fail_with_errno();
}

// Where the file system knows no second names there is no way back, but by then only a race can make a rename fail.
void AtomicFile::keep_replaced_file() {
  if (temporary_.empty() || !existed_) return;
  fs::path name = unused_name_beside(target_, ".old");
  std::error_code error;
  fs::create_hard_link(target_, name, error);
  if (!error) replaced_ = std::move(name);
}

void AtomicFile::take_name() {
  if (temporary_.empty()) return;
  std::error_code error;
  fs::rename(temporary_, target_, error);
  if (error) fail(error.message());
  temporary_.clear();
}

void AtomicFile::give_name_back() noexcept {
  std::error_code ignored;
  if (!replaced_.empty())
    fs::rename(replaced_, target_, ignored);
  else if (!existed_)
    fs::remove(target_, ignored);
  replaced_.clear();
}

void AtomicFile::forget_replaced_file() noexcept {
  std::error_code ignored;
  if (!replaced_.empty()) fs::remove(replaced_, ignored);
  replaced_.clear();
}

void AtomicFile::fail(std::string_view reason) const {
  throw IoError("cannot write '" + path_.string() + "': " + std::string(reason));
}

void AtomicFile::fail_with_errno() const {
  fail(reason_of(errno));
}

void write_file_atomic(const fs::path& path, std::span<const std::byte> bytes) {
  AtomicFile file(path);
  file.write(bytes);
  file.commit();
}

}  // namespace tetsoup
