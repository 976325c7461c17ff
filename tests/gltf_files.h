// glTF files of one buffer, put together accessor by accessor.
#pragma once

#include <string>
#include <vector>

#include "soup_files.h"

namespace tetsoup::test {

class GltfFile {
 public:
  /// A view of bytes at the buffer's next multiple of four; its number.
  int add_view(const std::string& bytes, const std::string& more = "") {
    buffer_.resize((buffer_.size() + 3) / 4 * 4);
    views_ += std::string(views_.empty() ? "" : ",") + R"({"buffer":0,"byteOffset":)" + std::to_string(buffer_.size()) +
              R"(,"byteLength":)" + std::to_string(bytes.size()) + more + "}";
    buffer_ += bytes;
    return view_count_++;
  }
  /// A view as it is described; its number.
  int add_described_view(const std::string& described) {
    views_ += (views_.empty() ? "" : ",") + described;
    return view_count_++;
  }
  /// An accessor of `count` elements; without a view where that is negative. Its number.
  int add_accessor(int view, int component, const std::string& type, std::size_t count) {
    accessors_ += std::string(accessors_.empty() ? "" : ",") + R"({"componentType":)" + std::to_string(component) +
                  R"(,"type":")" + type + R"(","count":)" + std::to_string(count) +
                  (view < 0 ? "" : R"(,"bufferView":)" + std::to_string(view)) + "}";
    return accessor_count_++;
  }
  int add_floats(const std::vector<float>& numbers, const std::string& type, std::size_t components) {
    std::string bytes;
    for (const float number : numbers) bytes += raw(number);
    return add_accessor(add_view(bytes), 5126, type, numbers.size() / components);
  }
  /// Bytes of the buffer so far.
  std::size_t size() const { return buffer_.size(); }

  /// @param rest  Nodes, meshes and whatever else, as members of the file's object.
  std::string text(const std::string& rest, const std::string& more_buffers = "") const {
    return R"({"asset":{"version":"2.0"},"bufferViews":[)" + views_ + R"(],"accessors":[)" + accessors_ +
           R"(],"buffers":[{"byteLength":)" + std::to_string(buffer_.size()) +
           R"(,"uri":"data:application/octet-stream;base64,)" + base64() + "\"}" + more_buffers + "]," + rest + "}";
  }

 private:
  std::string base64() const {
    static constexpr char kDigits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    const auto byte = [&](std::size_t i) {
      return i < buffer_.size() ? static_cast<unsigned>(static_cast<unsigned char>(buffer_[i])) : 0U;
    };
    for (std::size_t i = 0; i < buffer_.size(); i += 3) {
      const unsigned bits = byte(i) << 16 | byte(i + 1) << 8 | byte(i + 2);
      for (const int shift : {18, 12, 6, 0}) text += kDigits[bits >> shift & 63];
    }
    return text;
  }

  std::string buffer_, views_, accessors_;
  int view_count_ = 0, accessor_count_ = 0;
};

}  // namespace tetsoup::test
