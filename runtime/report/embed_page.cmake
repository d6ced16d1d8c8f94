# Turns the files of the page into one .cpp: cmake -DFOLDER=page -DOUTPUT=embedded_page.cpp -P embed_page.cmake
# The scripts are put together in the order of their use.

set(scripts data.js labels.js view3d.js charts.js tables.js main.js)

function(rapidc_literal name files)
  set(body "")
  foreach(file ${files})
    file(READ ${FOLDER}/${file} content)
    string(APPEND body "${content}")
  endforeach()
  set(text "${text}std::string_view ${name}() {\n    return R\"page(${body})page\";\n}\n\n" PARENT_SCOPE)
endfunction()

set(text "// Generated from runtime/report/page.\n#include \"runtime/report/page.h\"\n\nnamespace rt::report {\n\n")
rapidc_literal(pageFrame page.html)
rapidc_literal(pageStyle style.css)
rapidc_literal(pageScript "${scripts}")
file(WRITE ${OUTPUT} "${text}} // namespace rt::report\n")
