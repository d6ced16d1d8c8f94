# Turns models/*.json into one .cpp so that an executable has every model without its files.
# Called while configuring with RAPIDC_MODEL_DIR and RAPIDC_MODEL_OUTPUT; a changed model re-runs configuring.

function(rapidc_embed_models model_dir output)
  file(GLOB models CONFIGURE_DEPENDS ${model_dir}/*.json)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${models})
  set(text "// Generated from runtime/robot/models/*.json.\n#include \"runtime/robot/embedded_models.h\"\n\n")
  string(APPEND text "namespace robot {\n\nnamespace {\nconstexpr std::string_view kTexts[] = {\n")
  foreach(model ${models})
    file(READ ${model} content)
    string(APPEND text "R\"json(${content})json\",\n")
  endforeach()
  string(APPEND text "};\n} // namespace\n\n")
  string(APPEND text "std::span<const std::string_view> embeddedModelTexts() { return kTexts; }\n\n} // namespace robot\n")
  file(CONFIGURE OUTPUT ${output} CONTENT "@text@" @ONLY)
endfunction()
