# Who may include what: the order of the layers in docs/ARCHITECTURE.md, as one function over a file's path and the
# header it names.

# The flow. A layer sees the public headers of itself and of what stands before it, and its own private headers.
set(layers soup bodies distance pseudo_volume lattice smooth quality readiness embed regions simulate pipeline calibrate io scene report c)
# Public headers of a layer that has several.
set(io_headers tet_model engines animation label_volume)
# Public headers without a layer; everybody sees them. They see each other.
set(common_headers types error progress render_mesh)
# Private folders that every layer sees.
set(common_folders base kernel)
# Each third-party library of the core lives in one place.
set(tbb_home "^src/base/parallel\\.(h|cpp)$")
set(highway_home "^(src/kernel/|bench/bench_kernels\\.cpp$)")
set(eigen_home "^src/(base/symmetric_eigen|smooth/|simulate/held_factor)")

# include_complaint(out path quote header): why the file `path` (relative to the root) may not include `header`, which
# it names in `quote`, one of "\"" and "<"; empty if it may.
function(include_complaint out path quote header)
  set(${out} "" PARENT_SCOPE)
  foreach(library IN ITEMS "TBB;^(oneapi/)?tbb/;${tbb_home}" "Highway;^hwy/;${highway_home}"
                           "Eigen;^(unsupported/)?Eigen/;${eigen_home}")
    list(GET library 0 name)
    list(GET library 1 pattern)
    list(GET library 2 home)
    if(header MATCHES "${pattern}" AND NOT path MATCHES "${home}")
      set(${out} "${name} belongs to ${home} alone" PARENT_SCOPE)
      return()
    endif()
  endforeach()
  # Tests look behind every door, and one benchmark behind that of the kernels.
  if(path MATCHES "^(tests/|bench/bench_kernels\\.cpp$)")
    return()
  endif()

  include_layer_of(layer "${path}")
  if(layer STREQUAL "")
    set(${out} "no layer is known for this file: add it to tests/include_rules.cmake" PARENT_SCOPE)
  elseif(quote STREQUAL "<")
    include_system_complaint(complaint "${path}" "${layer}" "${header}")
    set(${out} "${complaint}" PARENT_SCOPE)
  else()
    include_own_complaint(complaint "${path}" "${layer}" "${header}")
    set(${out} "${complaint}" PARENT_SCOPE)
  endif()
endfunction()

# The layer a file of ours belongs to: a name out of `layers`, "common", "samples" or "outside" (the library's users).
function(include_layer_of out path)
  set(layer "")
  if(path MATCHES "^(apps|examples|bench|python|web)/")
    set(layer outside)
  elseif(path MATCHES "^(include/tetsoup|src)/tetsoup\\.(h|cpp)$")
    set(layer pipeline)
  elseif(path STREQUAL "include/tetsoup/tetsoup_c.h")
    set(layer c)
  elseif(path MATCHES "^(include/tetsoup|src)/([a-z_]+)(/|\\.h$|\\.cpp$)")
    set(name ${CMAKE_MATCH_2})
    if(name IN_LIST common_headers OR name IN_LIST common_folders)
      set(layer common)
    elseif(name IN_LIST io_headers)
      set(layer io)
    elseif(name IN_LIST layers OR name STREQUAL "samples")
      set(layer ${name})
    endif()
  endif()
  set(${out} "${layer}" PARENT_SCOPE)
endfunction()

# <...>: the core is standard C++ and neither reads files nor prints; io and the users of the library may do as they
# like within their own dependencies.
function(include_system_complaint out path layer header)
  set(complaint "")
  if(header MATCHES "^(tetsoup|base|kernel)/")
    set(complaint "our own headers are included with quotes")
  elseif(layer MATCHES "^(io|scene|report|c)$" AND path MATCHES "^src/" OR layer STREQUAL "outside")
    # No further rule.
  elseif(layer STREQUAL "c" AND header MATCHES "^std(def|int)\\.h$")
    # C's own.
  elseif(header MATCHES "^(tbb|oneapi|hwy|Eigen|unsupported)/" AND path MATCHES "^src/")
    # In its home, as seen above.
  elseif(header MATCHES "[/.]")
    set(complaint "only standard C++ headers here")
  elseif(header MATCHES "^(iostream|fstream|filesystem)$" AND NOT layer MATCHES "^(io|scene|report|c)$")
    set(complaint "the core reads no files and prints nothing")
  endif()
  set(${out} "${complaint}" PARENT_SCOPE)
endfunction()

# "...": a public header that stands earlier in the flow, a private one of the same folder, or a common one.
function(include_own_complaint out path layer header)
  set(complaint "")
  if(header MATCHES "^tetsoup/([a-z_]+)\\.h$")
    include_layer_of(other "include/${header}")
    list(FIND layers "${layer}" position)
    list(FIND layers "${other}" other_position)
    if(other STREQUAL "")
      set(complaint "no such public header in the flow: add it to tests/include_rules.cmake")
    elseif(other STREQUAL "common" OR other STREQUAL layer OR layer STREQUAL "outside")
      # Seen by everybody; its own; users see all.
    elseif(other STREQUAL "samples")
      if(NOT layer MATCHES "^(scene|c)$")
        set(complaint "samples serve scenes, C, tests, apps, benches and examples only")
      endif()
    elseif(path STREQUAL "include/tetsoup/tetsoup.h" AND other STREQUAL "c")
      # What a C compiler sees instead of the rest.
    elseif(layer MATCHES "^(common|samples)$" OR other_position GREATER position)
      set(complaint "${layer} stands before ${other} in the flow")
    endif()
  elseif(header MATCHES "^([a-z_]+)/")
    set(folder ${CMAKE_MATCH_1})
    if(NOT path MATCHES "^src/")
      set(complaint "private headers of src/ are not for public headers or users of the library")
    elseif(folder STREQUAL "kernel" AND path MATCHES "^src/base/")
      set(complaint "base stands before kernel in the flow")
    elseif(NOT folder IN_LIST common_folders AND NOT folder STREQUAL layer)
      set(complaint "private to src/${folder}")
    endif()
  elseif(path MATCHES "^(include|src)/")
    set(complaint "name the folder: tetsoup/${header} or <layer>/${header}")
  endif()
  set(${out} "${complaint}" PARENT_SCOPE)
endfunction()
