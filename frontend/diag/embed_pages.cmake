# Turns the pages of docs/diagnostics into one .cpp: cmake -DFOLDER=docs/diagnostics -DOUTPUT=embedded_pages.cpp -P embed_pages.cmake

file(GLOB pages ${FOLDER}/RAP*.md)
set(text "// Generated from docs/diagnostics.\n#include \"frontend/diag/explain_pages.h\"\n\n")
string(APPEND text "namespace rapid::diag {\n\nnamespace {\nconstexpr std::string_view kPages[] = {\n")
foreach(page ${pages})
  file(READ ${page} content)
  string(APPEND text "R\"page(${content})page\",\n")
endforeach()
string(APPEND text "};\n} // namespace\n\nstd::span<const std::string_view> embeddedPages() {\n    return kPages;\n}\n\n")
file(WRITE ${OUTPUT} "${text}} // namespace rapid::diag\n")
