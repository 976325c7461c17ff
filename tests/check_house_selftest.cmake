# cmake -DWORK_DIR=<scratch folder> -P check_house_selftest.cmake: do the checks of the house notice what they should?
cmake_minimum_required(VERSION 3.23)

# expect(check ok|fails path text): runs check_<check>.cmake over a tree of that one file.
function(expect check expected path text)
  file(REMOVE_RECURSE ${WORK_DIR})
  file(WRITE ${WORK_DIR}/${path} "// Planted.\n${text}\n")
  execute_process(COMMAND ${CMAKE_COMMAND} -DROOT=${WORK_DIR} -P ${CMAKE_CURRENT_LIST_DIR}/check_${check}.cmake
                  RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(expected STREQUAL "ok" AND NOT result EQUAL 0)
    message(SEND_ERROR "wrongly refused by ${check}: ${path} with ${text}\n${output}")
  elseif(expected STREQUAL "fails" AND (result EQUAL 0 OR NOT output MATCHES "${path}"))
    message(SEND_ERROR "not noticed by ${check}: ${path} with ${text}\n${output}")
  endif()
endfunction()

expect(elementary ok src/smooth/guard.cpp "double c = elementary::cos(x) + std::sqrt(y) + std::round(z);")
expect(elementary ok src/smooth/guard.cpp "evening.round(); sine(x); text(\"math.cos(x)\"); explog(x);")
expect(elementary ok src/smooth/guard.cpp "int a = 1;  // as std::cos(x) would")
expect(elementary ok src/io/pictures/raster.cpp "double d = std::hypot(x, y);")
expect(elementary ok src/base/elementary.cpp "double cos(double x) { return x; }")
expect(elementary fails src/smooth/guard.cpp "double c = std::cos(x);")
expect(elementary fails src/smooth/guard.h "double c = 2*cbrt(x);")
expect(elementary fails src/smooth/guard.cpp "float c = expf(x);")
expect(elementary fails src/scene/source.cpp "double c = std::pow (x, 2);")
expect(elementary fails src/io/engines/scene.cpp "  std::log10(x);")

set(begin "namespace tetsoup {\n")
set(end "}  // namespace\n")
expect(types ok src/a/b.h "${begin}struct Pose {\n}\nstruct Place {\n}\n${end}")
expect(types ok src/a/b.h "${begin}struct Pose {\n}\n${end}namespace tetsoup::a {\nstruct Pose {\n}\n${end}")
expect(types ok src/a/b.cpp "${begin}namespace {\nclass P {\n}\n${end}${end}class P {\n}\n")
expect(types ok src/a/b.h "${begin}struct Pose {\n}\nstruct Pose::Inner {\n}\n${end}")
expect(types fails src/a/b.h "${begin}struct Pose {\n}\nenum class Pose { A }\n${end}")
expect(types fails src/a/b.cpp "${begin}struct Pose {}\n${end}${begin}class Pose final : Q {\n}\n${end}")
expect(types fails src/a/b.cpp "${begin}namespace {\n${end}struct Pose {\n}\nstruct alignas(16) Pose {\n}\n${end}")

file(REMOVE_RECURSE ${WORK_DIR})
