// A predefined routine that is declared and not implemented (manual: none; docs/architecture.md, "One table for everything
// predefined"): check warns at its first call, and compiled code stops the program there. No built-in is in this state at
// present, so the environment names two.

#include "frontend/workspace/compilation.h"
#include "ir/lower/lower.h"
#include "ir/text/text.h"
#include "tests/harness/plain_environment.h"
#include "unit/temporary_folder.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <fstream>

using namespace rapid;

namespace {

class TwoMissing : public rapid::testing::PlainEnvironment {
  public:
    std::vector<std::string_view> declaredOnly() const override { return {"SiClose", "SiConnect"}; }
};

constexpr const char* kText = R"(MODULE DeclaredTwice
  PERS sensor camera := [0, 0, 0];
  PROC main()
    SiClose camera;
    helper;
    SiClose camera;
  ENDPROC
  PROC helper()
    IF reg1 = 1 SiClose camera;
    SiConnect camera;
  ENDPROC
ENDMODULE
)";

std::unique_ptr<workspace::Compilation> checkText(const TemporaryFolder& folder,
                                                  const workspace::Environment& environment) {
    const std::string path = (folder.path / "declared_twice.modx").string();
    std::ofstream(path) << kText;
    workspace::Inputs inputs;
    inputs.paths = {path};
    return workspace::checkInputs(inputs, environment);
}

} // namespace

TEST_CASE("a built-in that is declared only gets one warning, at its first call", "[workspace]") {
    const TemporaryFolder folder;
    const TwoMissing environment;
    const auto compilation = checkText(folder, environment);
    std::vector<std::string> found;
    for (const diag::Diagnostic& d : compilation->sink.sorted())
        if (diag::codeName(d.code) == "RAP7004")
            found.push_back(std::to_string(d.file->lineColumn(d.range.begin).line) + " " + d.message);
    REQUIRE(found.size() == 2);
    CHECK(found[0].starts_with("4 'SiClose' is declared but not implemented"));
    CHECK_THAT(found[0], Catch::Contains("here and in 2 more places"));
    CHECK(found[1].starts_with("10 'SiConnect' is declared but not implemented"));
}

TEST_CASE("a call of a built-in that is declared only stops the program", "[workspace][ir]") {
    const TemporaryFolder folder;
    const TwoMissing environment;
    const auto compilation = checkText(folder, environment);
    REQUIRE(compilation->program);
    lower::Options options;
    options.nativeImplemented = [](std::string_view symbol) { return !symbol.starts_with("rt_Si"); };
    ir::Module module;
    REQUIRE(lower::lowerProgram(*compilation->program, options, compilation->sink, module));
    const std::string text = ir::printModule(module);
    const auto count = [&text](std::string_view part) {
        size_t times = 0;
        for (size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1))
            ++times;
        return times;
    };
    CHECK(count("native @\"rt_notImplemented\" (") == 4);
    CHECK(count("native @\"rt_SiC") == 0);
}
