# What every target of this project is built with. Link rinkaku_build privately.
add_library(rinkaku_build INTERFACE)
target_include_directories(rinkaku_build INTERFACE "${PROJECT_SOURCE_DIR}")
target_compile_options(rinkaku_build INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor -Woverloaded-virtual -Wimplicit-fallthrough -Werror)

if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
  # GCC 12 warns of overlapping copies in "literal" + std::string where there are none (GCC bug 105651).
  target_compile_options(rinkaku_build INTERFACE -Wno-restrict)
endif()

find_program(CCACHE ccache)
if(CCACHE)
  set(CMAKE_CXX_COMPILER_LAUNCHER "${CCACHE}")
endif()

if(RINKAKU_SANITIZE)
  target_compile_options(rinkaku_build INTERFACE
    -fsanitize=${RINKAKU_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=all)
  target_link_options(rinkaku_build INTERFACE -fsanitize=${RINKAKU_SANITIZE})
  target_compile_definitions(rinkaku_build INTERFACE RINKAKU_SANITIZED=1)
  # GCC 12 then falsely reports, in library headers, maybe-uninitialized, and array-bounds of std::sort and strings.
  target_compile_options(rinkaku_build INTERFACE -Wno-maybe-uninitialized -Wno-array-bounds)
endif()

if(RINKAKU_FUZZ)
  target_compile_options(rinkaku_build INTERFACE -fsanitize=fuzzer-no-link,address,undefined -fno-omit-frame-pointer)
  target_link_options(rinkaku_build INTERFACE -fsanitize=address,undefined)
endif()

# Programs link this.
add_library(rinkaku_program INTERFACE)
target_link_libraries(rinkaku_program INTERFACE rinkaku_build)
if(RINKAKU_SANITIZE)
  add_library(rinkaku_sanitizer_suppressions OBJECT "${PROJECT_SOURCE_DIR}/cmake/sanitizer_suppressions.cpp")
  target_link_libraries(rinkaku_sanitizer_suppressions PRIVATE rinkaku_build)
  target_sources(rinkaku_program INTERFACE $<TARGET_OBJECTS:rinkaku_sanitizer_suppressions>)
endif()

# rinkaku_library(NAME SOURCES... ): a static library of this project.
function(rinkaku_library name)
  add_library(${name} STATIC ${ARGN})
  target_link_libraries(${name} PRIVATE rinkaku_build)
  target_include_directories(${name} PUBLIC "${PROJECT_SOURCE_DIR}")
endfunction()
