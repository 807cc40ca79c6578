# The text begins with a comment that names its file, by which gl::use_shaders_from() finds another version of it.
file(READ "${IN}" text)
if(IN MATCHES "\\.css$")
  set(heading "/* ${PATH_IN_SOURCES} */")
else()
  set(heading "// ${PATH_IN_SOURCES}")
endif()
file(WRITE "${OUT}" "#pragma once\n#include <string_view>\nnamespace rinkaku::embedded {\ninline constexpr std::string_view ${SYMBOL} = R\"shader(${heading}\n${text})shader\";\n}  // namespace rinkaku::embedded\n")
