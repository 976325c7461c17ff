# Turns studio/report/report.html into a source file, so that the tool needs no file beside it: run at build time, with
# -DPAGE and -DSOURCE. Strings of C++ are kept short enough for every compiler.
file(READ ${PAGE} html)
set(mark "id=\"tetsoup-report\">")
string(FIND "${html}" "${mark}" at)
if(at LESS 0)
  message(FATAL_ERROR "${PAGE} has no place for data")
endif()
string(LENGTH "${mark}" length)
math(EXPR at "${at} + ${length}")
string(SUBSTRING "${html}" 0 ${at} before)
string(SUBSTRING "${html}" ${at} -1 after)
# The template's own data, {}, goes.
string(REGEX REPLACE "^{}" "" after "${after}")
foreach(part IN ITEMS before after)
  string(LENGTH "${${part}}" length)
  set(literal "")
  set(from 0)
  while(from LESS length)
    string(SUBSTRING "${${part}}" ${from} 8000 piece)
    string(APPEND literal "R\"~page~(${piece})~page~\"\n")
    math(EXPR from "${from} + 8000")
  endwhile()
  set(${part} "${literal}")
endforeach()
file(WRITE ${SOURCE} "#include \"report/page_template.h\"\n\nnamespace tetsoup::page_template {\n\n"
  "const std::string_view kBeforeData =\n${before};\nconst std::string_view kAfterData =\n${after};\n\n"
  "}  // namespace tetsoup::page_template\n")
