# cmake -DROOT=<source tree> -P check_elementary.cmake: fails if src/ calls the C library's sin, exp, ... outside pictures.
#
# They differ between C libraries; src/base/elementary.h has those whose bits are the same everywhere.
cmake_minimum_required(VERSION 3.23)

set(names "sin|cos|tan|asin|acos|atan|atan2|sinh|cosh|tanh|asinh|acosh|atanh|exp|exp2|expm1|log|log2|log10|log1p|pow")
string(APPEND names "|cbrt|hypot|erf|erfc|tgamma|lgamma|sincos")
set(own_home "^src/base/elementary\\.(h|cpp)$")
set(drawn "^src/io/(pictures|animation)/")

file(GLOB_RECURSE files RELATIVE ${ROOT} ${ROOT}/src/*.h ${ROOT}/src/*.cpp)
set(complaints "")
set(file_count 0)
foreach(file IN LISTS files)
  math(EXPR file_count "${file_count} + 1")
  if(file MATCHES "${own_home}" OR file MATCHES "${drawn}")
    continue()
  endif()
  # A name in a namespace of our own or behind a point is another's; so is text behind //.
  file(STRINGS ${ROOT}/${file} lines REGEX "(^|std::|[^A-Za-z0-9_.:>\"])(${names})[fl]?[ ]*\\(")
  foreach(line IN LISTS lines)
    string(REGEX REPLACE "//.*" "" code "${line}")
    if(code MATCHES "(^|std::|[^A-Za-z0-9_.:>\"])(${names})[fl]?[ ]*\\(")
      string(APPEND complaints "  ${file} calls ${CMAKE_MATCH_2}:${code}\n")
    endif()
  endforeach()
endforeach()

if(complaints)
  message(FATAL_ERROR "Results would depend on the C library; take base/elementary.h:\n${complaints}")
elseif(file_count EQUAL 0)
  message(FATAL_ERROR "No files found below ${ROOT}/src: nothing was checked")
endif()
message("${file_count} files call no function whose last bit differs between C libraries")
