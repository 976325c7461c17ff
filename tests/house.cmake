# Tests of the house itself: the order of includes, names of types, functions that results may depend on; and strangers'
# projects that use tetsoup both ways.

add_test(NAME house.include_order
  COMMAND ${CMAKE_COMMAND} -DROOT=${PROJECT_SOURCE_DIR} -P ${CMAKE_CURRENT_SOURCE_DIR}/check_includes.cmake)
add_test(NAME house.include_order_notices_planted_violations
  COMMAND ${CMAKE_COMMAND} -DWORK_DIR=${CMAKE_CURRENT_BINARY_DIR}/planted
          -P ${CMAKE_CURRENT_SOURCE_DIR}/check_includes_selftest.cmake)
add_test(NAME house.results_do_not_depend_on_the_c_library
  COMMAND ${CMAKE_COMMAND} -DROOT=${PROJECT_SOURCE_DIR} -P ${CMAKE_CURRENT_SOURCE_DIR}/check_elementary.cmake)
add_test(NAME house.every_type_has_a_name_of_its_own
  COMMAND ${CMAKE_COMMAND} -DROOT=${PROJECT_SOURCE_DIR} -P ${CMAKE_CURRENT_SOURCE_DIR}/check_types.cmake)
add_test(NAME house.checks_notice_planted_violations
  COMMAND ${CMAKE_COMMAND} -DWORK_DIR=${CMAKE_CURRENT_BINARY_DIR}/planted_house
          -P ${CMAKE_CURRENT_SOURCE_DIR}/check_house_selftest.cmake)

# tetsoup_add_consumer_test(name, options for the consumer's CMake...): configures, builds and runs tests/consumer.
function(tetsoup_add_consumer_test name)
  add_test(NAME consumer.${name} COMMAND ${CMAKE_CTEST_COMMAND}
    --build-and-test ${CMAKE_CURRENT_SOURCE_DIR}/consumer ${CMAKE_CURRENT_BINARY_DIR}/consumer/${name}
    --build-generator ${CMAKE_GENERATOR} --build-noclean
    --build-options -DCMAKE_BUILD_TYPE=${CMAKE_BUILD_TYPE} -DCMAKE_CXX_COMPILER=${CMAKE_CXX_COMPILER}
      "-DCMAKE_CXX_FLAGS=${CMAKE_CXX_FLAGS}" "-DCMAKE_CXX_COMPILER_LAUNCHER=${CMAKE_CXX_COMPILER_LAUNCHER}"
      "-DCMAKE_TOOLCHAIN_FILE=${CMAKE_TOOLCHAIN_FILE}" ${ARGN}
    --test-command consumer)
  set_tests_properties(consumer.${name} PROPERTIES LABELS consumer TIMEOUT 1800)  # it builds the core anew
endfunction()

# A surrounding project that prefers shared libraries, and has neither libpng nor tinygltf.
tetsoup_add_consumer_test(add_subdirectory -DTETSOUP_SOURCE=${PROJECT_SOURCE_DIR} -DTETSOUP_TBB=${TETSOUP_TBB}
  -DBUILD_SHARED_LIBS=ON -DCMAKE_DISABLE_FIND_PACKAGE_PNG=ON -DCMAKE_DISABLE_FIND_PACKAGE_TinyGLTF=ON)

# The install prefix is made afresh, from what is built here; a core consumer must not even look for what io needs.
if(TETSOUP_INSTALL)
  set(prefix ${CMAKE_CURRENT_BINARY_DIR}/consumer/prefix)
  add_test(NAME consumer.clean COMMAND ${CMAKE_COMMAND} -E rm -rf ${prefix})
  set_tests_properties(consumer.clean PROPERTIES LABELS consumer FIXTURES_SETUP tetsoup_clean)
  add_test(NAME consumer.install COMMAND ${CMAKE_COMMAND} --install ${PROJECT_BINARY_DIR} --prefix ${prefix}
    --component tetsoup_development)
  set_tests_properties(consumer.install PROPERTIES LABELS consumer FIXTURES_REQUIRED tetsoup_clean
    FIXTURES_SETUP tetsoup_prefix)
  tetsoup_add_consumer_test(find_package -DCMAKE_PREFIX_PATH=${prefix} -DCMAKE_DISABLE_FIND_PACKAGE_Eigen3=ON
    -DCMAKE_DISABLE_FIND_PACKAGE_PNG=ON -DCMAKE_DISABLE_FIND_PACKAGE_TinyGLTF=ON)
  tetsoup_add_consumer_test(find_package_io -DCMAKE_PREFIX_PATH=${prefix} -DUSE_IO=ON
    -DCMAKE_DISABLE_FIND_PACKAGE_Eigen3=ON -DCMAKE_DISABLE_FIND_PACKAGE_nlohmann_json=ON)
  set_tests_properties(consumer.find_package consumer.find_package_io PROPERTIES FIXTURES_REQUIRED tetsoup_prefix)
endif()
