// Files that appear whole or not at all: what is written goes to a temporary beside the target, is brought to the disk,
// and is renamed at the end. Whatever happens before, an existing file stays as it was and no temporary is left.
#pragma once

#include <cstddef>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <span>
#include <string_view>

namespace tetsoup {

class AtomicFile {
 public:
  /// Symbolic links are followed and stay links. Devices and pipes (/dev/stdout) are written directly, since they
  /// cannot be renamed over.
  /// @throws IoError  with the path and the reason, as do all the others.
  explicit AtomicFile(const std::filesystem::path& path);
  AtomicFile(AtomicFile&& other) noexcept;
  AtomicFile& operator=(AtomicFile&&) = delete;
  ~AtomicFile();

  void write(std::string_view text);
  void write(std::span<const std::byte> bytes);
  void commit();

  /// Completes all files before the first takes its name; if one of them cannot, none does.
  static void commit_together(std::span<AtomicFile> files);

 private:
  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };

  void open_temporary();
  void open_directly();
  void close();
  void bring_to_disk();
  void keep_replaced_file();
  void take_name();
  void give_name_back() noexcept;
  void forget_replaced_file() noexcept;
  [[noreturn]] void fail(std::string_view reason) const;
  [[noreturn]] void fail_with_errno() const;

  std::filesystem::path path_;       // As the caller named it, for messages.
  std::filesystem::path target_;     // Where the links lead.
  std::filesystem::path temporary_;  // Empty once renamed, and for devices.
  std::filesystem::path replaced_;   // Second name of the file replaced, to bring it back.
  bool existed_ = false;
  std::unique_ptr<std::FILE, Close> file_;
};

}  // namespace tetsoup
