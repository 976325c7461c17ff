# The libraries that WebAssembly needs, out of the system's headers: Emscripten finds no packages of the machine that
# builds, and must not see all of /usr/include. Defines the targets that find_package() would.
# 128-bit SIMD and exceptions of WebAssembly itself, which every browser has had for years.
add_compile_options(-msimd128 -fwasm-exceptions)
add_link_options(-fwasm-exceptions)
# Grids and meshes take what they need, up to what every browser gives.
add_link_options(-sALLOW_MEMORY_GROWTH -sINITIAL_MEMORY=64MB -sMAXIMUM_MEMORY=2GB)
# Debian's Emscripten needs Debian's JavaScript packages, which a Node.js from elsewhere does not look for.
set_property(GLOBAL PROPERTY RULE_LAUNCH_LINK "${CMAKE_COMMAND} -E env NODE_PATH=/usr/share/nodejs")
if(TETSOUP_POOL)
  add_compile_options(-pthread)
  # The threads are there before they are asked for: one that works cannot wait for the browser to make them.
  add_link_options(-pthread -Wno-pthreads-mem-growth
    "-sPTHREAD_POOL_SIZE=(typeof navigator=='object'&&navigator.hardwareConcurrency||2)-1")
endif()

set(wasm_headers ${PROJECT_BINARY_DIR}/headers)
file(MAKE_DIRECTORY ${wasm_headers})

# tetsoup_wasm_header(package target header): one folder or file, linked into a folder of its own.
function(tetsoup_wasm_header package target header)
  find_path(wasm_home_of_${package} ${header} PATHS /usr/local/include /usr/include PATH_SUFFIXES eigen3
            NO_DEFAULT_PATH NO_CMAKE_FIND_ROOT_PATH REQUIRED)
  string(REGEX REPLACE "/.*" "" top ${header})
  file(MAKE_DIRECTORY ${wasm_headers}/${package})
  file(CREATE_LINK ${wasm_home_of_${package}}/${top} ${wasm_headers}/${package}/${top} SYMBOLIC)
  add_library(${target} INTERFACE IMPORTED GLOBAL)
  target_include_directories(${target} SYSTEM INTERFACE ${wasm_headers}/${package})
endfunction()

# tetsoup_wasm_package(package): find_package() is content with what is defined here.
function(tetsoup_wasm_package package)
  string(TOLOWER ${package} file)
  file(WRITE ${PROJECT_BINARY_DIR}/packages/${file}-config.cmake "")
  file(WRITE ${PROJECT_BINARY_DIR}/packages/${file}-config-version.cmake "set(PACKAGE_VERSION_COMPATIBLE TRUE)\n")
  set(${package}_DIR ${PROJECT_BINARY_DIR}/packages CACHE PATH "" FORCE)
endfunction()

tetsoup_wasm_header(Eigen3 Eigen3::Eigen Eigen/Core)
tetsoup_wasm_header(hwy hwy::hwy hwy/highway.h)
tetsoup_wasm_header(nlohmann_json nlohmann_json::nlohmann_json nlohmann/json.hpp)
tetsoup_wasm_header(TinyGLTF tinygltf_headers tiny_gltf.h)

# tinygltf without what reads and writes pictures, which nobody asks it for.
file(WRITE ${PROJECT_BINARY_DIR}/tinygltf.cpp
  "#define TINYGLTF_IMPLEMENTATION\n#define TINYGLTF_NO_EXTERNAL_IMAGE\n#include <tiny_gltf.h>\n")
add_library(tinygltf STATIC ${PROJECT_BINARY_DIR}/tinygltf.cpp)
target_link_libraries(tinygltf PUBLIC tinygltf_headers nlohmann_json::nlohmann_json)
target_compile_definitions(tinygltf PUBLIC TINYGLTF_NO_STB_IMAGE TINYGLTF_NO_STB_IMAGE_WRITE)
target_compile_features(tinygltf PUBLIC cxx_std_20)
add_library(TinyGLTF::TinyGLTF ALIAS tinygltf)

foreach(package IN ITEMS Eigen3 hwy nlohmann_json TinyGLTF)
  tetsoup_wasm_package(${package})
endforeach()
