file(READ "${IN}" text)
file(WRITE "${OUT}" "#pragma once\n#include <string_view>\nnamespace rinkaku::embedded {\ninline constexpr std::string_view ${SYMBOL} = R\"shader(${text})shader\";\n}  // namespace rinkaku::embedded\n")
