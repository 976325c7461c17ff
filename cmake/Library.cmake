# tetsoup_add_library(name folder...): a static library of all sources below src/<folder>, with the project's warnings.

function(tetsoup_set_warnings target)
  target_compile_options(${target} PRIVATE -Wall -Wextra -Wshadow -Wconversion $<$<BOOL:${TETSOUP_WERROR}>:-Werror>)
  # g++ 12 warns falsely of overlap in "text" + std::string (GCC bug 105651), and of bounds as well where a precompiled
  # header hides that the text is a system header's.
  target_compile_options(${target} PRIVATE
    $<$<AND:$<CXX_COMPILER_ID:GNU>,$<VERSION_LESS:$<CXX_COMPILER_VERSION>,13>>:-Wno-restrict>
    $<$<AND:$<BOOL:${TETSOUP_PCH}>,$<CXX_COMPILER_ID:GNU>>:-Wno-array-bounds;-Wno-stringop-overflow>)
  # There sizes have 32 bits, and whatever they count fits, since each takes memory.
  target_compile_options(${target} PRIVATE $<$<BOOL:${EMSCRIPTEN}>:-Wno-shorten-64-to-32>)
  # Same bits on every instruction set: no contraction of a * b + c. The other two let loops with selects be vectorised and
  # change no result.
  target_compile_options(${target} PRIVATE -ffp-contract=off -fno-math-errno -fno-trapping-math)
endfunction()

# tetsoup_parse_once(target header...): with TETSOUP_PCH, these and the common standard headers are parsed once. A file
# that leans on them instead of including what it uses is found by the builds without it, the consumers' among them.
function(tetsoup_parse_once target)
  if(TETSOUP_PCH)
    target_precompile_headers(${target} PRIVATE <algorithm> <array> <atomic> <chrono> <cmath> <functional> <map> <memory>
                              <numeric> <optional> <string> <vector> ${ARGN})
  endif()
endfunction()

function(tetsoup_add_library name)
  set(sources "")
  foreach(folder IN LISTS ARGN)
    file(GLOB found CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/src/${folder}/*.cpp)
    list(APPEND sources ${found})
  endforeach()
  # Static whatever the surrounding project prefers: no symbol is exported for a shared one.
  add_library(${name} STATIC ${sources})
  if(NOT TARGET tetsoup::${name})
    add_library(tetsoup::${name} ALIAS ${name})
  endif()
  target_compile_features(${name} PUBLIC cxx_std_20)
  set_target_properties(${name} PROPERTIES POSITION_INDEPENDENT_CODE ON VERIFY_INTERFACE_HEADER_SETS ON
                        CXX_VISIBILITY_PRESET hidden)
  target_include_directories(${name} PRIVATE ${PROJECT_SOURCE_DIR}/src)
  target_compile_definitions(${name} PRIVATE $<$<BOOL:${TETSOUP_CHECKED}>:TETSOUP_CHECKED>)
  tetsoup_set_warnings(${name})
  # Tells libFuzzer where the code goes; other programs do not mind.
  target_compile_options(${name} PRIVATE $<$<BOOL:${TETSOUP_FUZZ}>:-fsanitize=fuzzer-no-link>)
endfunction()
