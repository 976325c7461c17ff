// NumPy's .npz: a zip of uncompressed .npy arrays. Same arrays, same bytes: no dates, no permissions.
#pragma once

#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace tetsoup {

class NpzWriter {
 public:
  /// Numbers row after row, as many as the shape has; an empty shape is one number.
  template <class Number>
  void add(std::string_view name, std::initializer_list<std::size_t> shape, std::span<const Number> numbers) {
    constexpr char kind = std::floating_point<Number> ? 'f' : std::unsigned_integral<Number> ? 'u' : 'i';
    const std::string type = std::string("<") + kind + std::to_string(sizeof(Number));
    add_array(name, type, shape, {reinterpret_cast<const char*>(numbers.data()), numbers.size_bytes()});
  }
  /// Texts as NumPy's unicode.
  void add_texts(std::string_view name, std::span<const std::string> texts);

  /// The file's bytes. Adding is over then.
  /// @throws IoError  if they are too many for the 32-bit offsets of a zip file.
  std::string take();

 private:
  void add_array(std::string_view name, const std::string& type, std::initializer_list<std::size_t> shape,
                 std::string_view bytes);

  std::string bytes_, directory_;
  std::size_t count_ = 0;
};

/// An array within the bytes of its file.
struct NpzArray {
  std::string type;  ///< As NumPy calls it: "<f4".
  std::vector<std::size_t> shape;
  std::string_view bytes;  ///< All that the shape asks for; row after row.
  std::size_t offset = 0;  ///< In the file, for errors.

  std::size_t count() const;
};

/// The arrays of a file by name. Compressed ones, and such in column order, are errors; so are files that lie about
/// sizes. Arrays of types other than numbers are left out.
/// @throws IoError  naming the byte; `name` stands for the path.
std::map<std::string, NpzArray> read_npz(std::string_view bytes, const std::string& name);

/// An array's numbers, whatever they are stored as.
/// @param columns  Wanted in every row; 0: numbers without rows.
/// @throws IoError  naming the array, if it is missing, has another shape, or holds what an index cannot be.
std::vector<double> npz_reals(const std::map<std::string, NpzArray>& arrays, const std::string& file,
                              const std::string& array, std::size_t columns);
std::vector<std::uint32_t> npz_indices(const std::map<std::string, NpzArray>& arrays, const std::string& file,
                                       const std::string& array, std::size_t columns);

}  // namespace tetsoup
