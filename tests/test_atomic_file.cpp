// Files appear whole or not at all.
#include "io/atomic_file.h"

#include <sys/resource.h>
#include <sys/stat.h>

#include <array>
#include <csignal>
#include <cstdio>
#include <stdexcept>
#include <string>

#include "tet_file_fixtures.h"
#include "tetsoup/io.h"

namespace tetsoup {

namespace fs = std::filesystem;

namespace {

using AtomicFileTest = FolderTest;

void write_text(const fs::path& path, std::string_view text) {
  AtomicFile file(path);
  file.write(text);
  file.commit();
}

// Files may not grow beyond `bytes` while it lives.
class FileSizeLimit {
 public:
  explicit FileSizeLimit(rlim_t bytes) : old_handler_(std::signal(SIGXFSZ, SIG_IGN)) {
    getrlimit(RLIMIT_FSIZE, &old_);
    rlimit limit = old_;
    limit.rlim_cur = bytes;
    setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FileSizeLimit() {
    setrlimit(RLIMIT_FSIZE, &old_);
    std::signal(SIGXFSZ, old_handler_);
  }

 private:
  rlimit old_{};
  void (*old_handler_)(int);
};

}  // namespace

TEST_F(AtomicFileTest, a_committed_file_holds_what_was_written_and_nothing_else_is_left) {
  const fs::path path = folder_ / "a.txt";
  write_text(path, "first");
  EXPECT_EQ(bytes_of(path), "first");
  write_text(path, "second");
  EXPECT_EQ(bytes_of(path), "second");
  EXPECT_EQ(files(), std::vector<std::string>{"a.txt"});
}

TEST_F(AtomicFileTest, without_commit_the_old_file_stays_and_no_temporary_is_left) {
  put_file(folder_ / "a.txt", "old");
  try {
    AtomicFile file(folder_ / "a.txt");
    file.write("half of the n");
    throw std::runtime_error("cancelled");
  } catch (const std::runtime_error&) {
  }
  EXPECT_EQ(bytes_of(folder_ / "a.txt"), "old");
  EXPECT_EQ(files(), std::vector<std::string>{"a.txt"});
}

TEST_F(AtomicFileTest, a_missing_folder_is_named) {
  const std::string text = io_error_of([&] { write_text(folder_ / "none" / "a.txt", "x"); });
  EXPECT_NE(text.find((folder_ / "none" / "a.txt").string()), text.npos) << text;
  EXPECT_NE(text.find("the folder '" + (folder_ / "none").string() + "' does not exist"), text.npos) << text;
}

TEST_F(AtomicFileTest, a_file_in_the_place_of_a_folder_is_an_error_with_the_systems_reason) {
  put_file(folder_ / "a.txt", "old");
  EXPECT_NE(io_error_of([&] { write_text(folder_ / "a.txt" / "b.txt", "x"); }).find("Not a directory"),
            std::string::npos);
}

TEST_F(AtomicFileTest, a_folder_is_not_replaced) {
  fs::create_directory(folder_ / "sub");
  const std::string text = io_error_of([&] { write_text(folder_ / "sub", "x"); });
  EXPECT_NE(text.find("it is a folder"), text.npos) << text;
  EXPECT_EQ(files(), std::vector<std::string>{"sub"});
}

TEST_F(AtomicFileTest, a_name_of_the_longest_length_can_be_written) {
  write_text(folder_ / std::string(255, 'n'), "x");
  EXPECT_EQ(bytes_of(folder_ / std::string(255, 'n')), "x");
  EXPECT_THROW(write_text(folder_ / std::string(256, 'n'), "x"), IoError);
  EXPECT_EQ(files().size(), 1U);
}

TEST_F(AtomicFileTest, a_full_disk_is_reported) {
  if (!fs::exists("/dev/full")) GTEST_SKIP() << "this system has no /dev/full";
  const std::string text = io_error_of([&] { write_text("/dev/full", std::string(100'000, 'x')); });
  EXPECT_NE(text.find("No space left on device"), text.npos) << text;
  const std::string late = io_error_of([&] { write_text("/dev/full", "x"); });
  EXPECT_NE(late.find("No space left on device"), late.npos) << late;
}

TEST_F(AtomicFileTest, a_write_that_fails_half_way_leaves_the_old_file) {
  put_file(folder_ / "a.txt", "old");
  for (const std::size_t size : {1'000'000U, 5'000U}) {
    const FileSizeLimit limit(4096);
    const std::string text = io_error_of([&] { write_text(folder_ / "a.txt", std::string(size, 'x')); });
    EXPECT_NE(text.find("File too large"), text.npos) << text;
  }
  EXPECT_EQ(bytes_of(folder_ / "a.txt"), "old");
  EXPECT_EQ(files(), std::vector<std::string>{"a.txt"});
}

TEST_F(AtomicFileTest, links_are_followed_and_stay_links) {
  fs::create_directory(folder_ / "sub");
  put_file(folder_ / "sub" / "real.txt", "old");
  fs::create_symlink("sub/real.txt", folder_ / "link.txt");
  fs::create_symlink("link.txt", folder_ / "link_to_link.txt");
  write_text(folder_ / "link_to_link.txt", "new");
  EXPECT_TRUE(fs::is_symlink(folder_ / "link.txt") && fs::is_symlink(folder_ / "link_to_link.txt"));
  EXPECT_EQ(bytes_of(folder_ / "sub" / "real.txt"), "new");
  fs::create_symlink("made.txt", folder_ / "dangling.txt");
  write_text(folder_ / "dangling.txt", "made");
  EXPECT_EQ(bytes_of(folder_ / "made.txt"), "made");
}

TEST_F(AtomicFileTest, links_in_a_circle_are_an_error) {
  fs::create_symlink("b", folder_ / "a");
  fs::create_symlink("a", folder_ / "b");
  EXPECT_NE(io_error_of([&] { write_text(folder_ / "a", "x"); }).find("symbolic links"), std::string::npos);
}

TEST_F(AtomicFileTest, devices_and_open_descriptors_are_written_to_not_replaced) {
  write_text("/dev/null", "x");
  EXPECT_TRUE(fs::is_character_file("/dev/null"));
  if (!fs::exists("/proc/self/fd")) GTEST_SKIP() << "this system has no /proc";
  std::FILE* out = std::fopen((folder_ / "out.txt").c_str(), "wb");
  std::fputs("before ", out);
  std::fflush(out);
  write_text("/dev/fd/" + std::to_string(fileno(out)), "written");
  std::fclose(out);
  EXPECT_EQ(bytes_of(folder_ / "out.txt"), "before written");
}

TEST_F(AtomicFileTest, new_files_follow_the_umask_and_replaced_ones_keep_their_permissions) {
  const mode_t old_mask = ::umask(027);
  write_text(folder_ / "new.txt", "x");
  ::umask(old_mask);
  EXPECT_EQ(fs::status(folder_ / "new.txt").permissions(), static_cast<fs::perms>(0640));
  fs::permissions(folder_ / "new.txt", static_cast<fs::perms>(0600));
  write_text(folder_ / "new.txt", "y");
  EXPECT_EQ(fs::status(folder_ / "new.txt").permissions(), static_cast<fs::perms>(0600));
}

TEST_F(AtomicFileTest, of_files_committed_together_none_appears_if_one_cannot) {
  put_file(folder_ / "old.txt", "old");
  {
    std::array<AtomicFile, 3> set{AtomicFile(folder_ / "old.txt"), AtomicFile(folder_ / "fresh.txt"),
                                  AtomicFile(folder_ / "taken.txt")};
    for (AtomicFile& file : set) file.write("new");
    fs::create_directory(folder_ / "taken.txt");  // After the check at opening, so only the last rename fails.
    io_error_of([&] { AtomicFile::commit_together(set); });
  }
  EXPECT_EQ(bytes_of(folder_ / "old.txt"), "old");
  EXPECT_EQ(files(), (std::vector<std::string>{"old.txt", "taken.txt"}));
}

TEST_F(AtomicFileTest, files_committed_together_all_appear) {
  put_file(folder_ / "a", "old");
  std::vector<AtomicFile> set;
  for (const char* name : {"a", "b", "c"}) set.emplace_back(folder_ / name);
  for (AtomicFile& file : set) file.write("new");
  EXPECT_EQ(bytes_of(folder_ / "a"), "old");
  AtomicFile::commit_together(set);
  EXPECT_EQ(files(), (std::vector<std::string>{"a", "b", "c"}));
  EXPECT_EQ(bytes_of(folder_ / "a") + bytes_of(folder_ / "c"), "newnew");
}

TEST_F(AtomicFileTest, bytes_are_written_as_they_are) {
  const std::string bytes("\0\r\n\x1a\xff", 5);
  write_file_atomic(folder_ / "b", std::as_bytes(std::span(bytes)));
  EXPECT_EQ(bytes_of(folder_ / "b"), bytes);
  write_file_atomic(folder_ / "b", {});
  EXPECT_EQ(bytes_of(folder_ / "b"), "");
}

}  // namespace tetsoup
