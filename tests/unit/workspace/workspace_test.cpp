// A workspace says of its texts what a check of everything says, whatever was typed, added or removed before.

#include "frontend/workspace/workspace.h"
#include "tests/harness/plain_environment.h"
#include "unit/temporary_folder.h"

#include <catch2/catch.hpp>

#include <filesystem>
#include <fstream>
#include <random>

using namespace rapid;
using namespace rapid::workspace;
namespace fs = std::filesystem;

namespace {

const rapid::testing::PlainEnvironment kEnvironment;

std::string show(const std::vector<diag::Diagnostic>& diagnostics) {
    std::string out;
    for (const diag::Diagnostic& d : diagnostics) {
        out += diag::codeName(d.code) + " " + (d.file ? d.file->path() : "-") + ":" +
               std::to_string(d.range.begin) + "-" + std::to_string(d.range.end) + " " + d.message + "\n";
        for (const auto& note : d.notes)
            out += "    " + note.file->path() + ":" + std::to_string(note.range.begin) + " " + note.message +
                   "\n";
        for (const auto& fix : d.fixes)
            out += "    fix: " + fix.message + "\n";
    }
    return out;
}

/// The messages of `rapidc check ROOT` about the same texts.
std::string checked(const std::string& root, const Workspace& workspace,
                    const std::vector<std::string>& warnings = {}) {
    Inputs inputs;
    inputs.paths = {root};
    inputs.lint = true;
    inputs.onlyDiagnostics = true;
    inputs.warnings = warnings;
    inputs.texts = &workspace.texts();
    return show(checkInputs(inputs, kEnvironment)->sink.sorted());
}

/// A folder with files, absolute.
struct Folder {
    TemporaryFolder temporary;
    std::string path = fs::canonical(temporary.path).string();

    std::string write(const std::string& name, const std::string& text) const {
        const fs::path file = fs::path(path) / name;
        fs::create_directories(file.parent_path());
        std::ofstream(file, std::ios::binary) << text;
        return file.string();
    }
};

constexpr const char* kMain = R"(MODULE MainModule
  PERS num count := 0;
  VAR num spare;
  PROC main()
    VAR num high := 3;
    FOR i FROM 1 TO 4 DO
      fetch high \fast;
    ENDFOR
    IF total() > 2 stopAll;
  ERROR
    TRYNEXT;
  ENDPROC
  LOCAL PROC stopAll()
    TPWrite "stop" \Num:=count;
    ! rapidc: ignore unused-variable
    count := 0;
  ENDPROC
  LOCAL PROC never()
    WaitTime 1;
  ENDPROC
ENDMODULE
)";
constexpr const char* kWork = R"(MODULE Work
  CONST robtarget home := [[600, 0, 700], [1, 0, 0, 0], [0, 0, 0, 0], [9E9, 9E9, 9E9, 9E9, 9E9, 9E9]];
  LOCAL VAR num calls;
  PROC fetch(num speed \switch fast | num slow)
    calls := calls + 1;
    IF Present(slow) calls := slow;
    MoveL Offs(home, 0, 0, speed), v500, z10, tool0;
  ENDPROC
  FUNC num total()
    VAR num sum := 0;
    WHILE sum < 3 DO
      sum := sum + calls;
    ENDWHILE
    RETURN sum;
  ENDFUNC
ENDMODULE
)";

std::string edited(std::mt19937& random, std::string text, const std::string& other) {
    const auto below = [&](size_t n) { return n == 0 ? 0 : random() % n; };
    const size_t at = below(text.size() + 1);
    switch (below(5)) {
    case 0: return text.erase(at, below(30));
    case 1: return text.insert(at, other.substr(below(other.size()), below(40)));
    case 2: return text.insert(at, 1, ";,()[]:=!\"x1 \n"[below(14)]);
    case 3: return text.insert(std::min(text.find('\n', at), text.size()), "\n    VAR num fresh;");
    default: return text.insert(std::min(text.find('\n', at), text.size()), "\n! remark");
    }
}

} // namespace

TEST_CASE("a workspace says after each edit what a check of the folder says", "[workspace]") {
    const Folder folder;
    const std::string paths[] = {folder.write("a.modx", kMain), folder.write("b.modx", kWork)};
    const std::string originals[] = {kMain, kWork};
    for (unsigned seed = 1; seed <= 3; ++seed) {
        std::mt19937 random(seed);
        Workspace workspace(kEnvironment);
        workspace.setFolders({folder.path});
        std::string texts[] = {kMain, kWork};
        for (int step = 0; step < 60; ++step) {
            const size_t which = random() % 2;
            texts[which] =
                random() % 4 == 0 ? originals[which] : edited(random, texts[which], originals[1 - which]);
            workspace.setText(paths[which], texts[which]);
            Program* program = workspace.programOf(paths[which]);
            REQUIRE(program);
            INFO("seed " << seed << " step " << step << "\n" << texts[which]);
            REQUIRE(show(program->diagnostics()) == checked(folder.path, workspace));
        }
    }
}

TEST_CASE("quick messages are those of the check, and warnings whose places are still there", "[workspace]") {
    const Folder folder;
    const std::string path = folder.write("a.modx", kMain);
    folder.write("b.modx", kWork);
    Workspace workspace(kEnvironment);
    workspace.setFolders({folder.path});
    Program* program = workspace.programOf(path);
    REQUIRE(program);
    const std::string before = show(program->diagnostics());
    CHECK(before.find("RAP8003") != std::string::npos); // 'spare' is never used
    workspace.setText(path, "! a remark above everything\n" + std::string(kMain));
    program = workspace.programOf(path);
    const std::string quick = show(program->quickDiagnostics(path));
    CHECK(quick == checked(folder.path, workspace));
    std::string wrong = kMain;
    wrong.insert(wrong.find("    count := 0;"), "    count := \"text\";\n");
    workspace.setText(path, wrong);
    program = workspace.programOf(path);
    CHECK(show(program->quickDiagnostics(path)).find("RAP2104") != std::string::npos);
}

TEST_CASE("files of a folder come, change and vanish", "[workspace]") {
    const Folder folder;
    const std::string main = folder.write("a.modx", kMain);
    Workspace workspace(kEnvironment);
    workspace.setFolders({folder.path});
    CHECK(workspace.programOf(main)->diagnostics().size() > 1); // fetch and total are unknown

    const std::string work = (fs::path(folder.path) / "b.modx").string();
    workspace.setText(work, kWork); // not saved yet
    CHECK(show(workspace.programOf(main)->diagnostics()) == checked(folder.path, workspace));
    CHECK(workspace.programOf(main)->hasModule(work));
    workspace.dropText(work);
    CHECK_FALSE(workspace.programOf(main)->hasModule(work));

    folder.write("b.modx", kWork);
    workspace.fileChanged(work);
    CHECK(workspace.programOf(main)->hasModule(work));
    folder.write("b.modx", "MODULE Work\nENDMODULE\n");
    workspace.fileChanged(work);
    CHECK(workspace.programOf(main)->tree(work)->modules.size() == 1);
    CHECK(show(workspace.programOf(main)->diagnostics()) == checked(folder.path, workspace));
    fs::remove(work);
    workspace.fileChanged(work);
    CHECK_FALSE(workspace.programOf(main)->hasModule(work));
    CHECK(show(workspace.programOf(main)->diagnostics()) == checked(folder.path, workspace));
}

TEST_CASE("an open text counts before the file, in its own folder", "[workspace]") {
    const Folder folder;
    const std::string first = folder.write("one/a.modx", kMain), second = folder.write("two/a.modx", kMain);
    Workspace workspace(kEnvironment);
    workspace.setFolders({folder.path + "/one", folder.path + "/two"});
    REQUIRE(workspace.programs().size() == 2);
    workspace.setText(first, "MODULE other\nENDMODULE\n");
    CHECK(workspace.programOf(first)->tree(first)->source->text().starts_with("MODULE other"));
    CHECK(workspace.programOf(second)->tree(second)->source->text().starts_with("MODULE MainModule"));
    CHECK(workspace.programOf(first) != workspace.programOf(second));
    CHECK(workspace.read(first)->text().starts_with("MODULE other"));
    workspace.dropText(first);
    CHECK(workspace.read(first)->text().starts_with("MODULE MainModule"));
}

TEST_CASE("modules of no folder are programs by themselves", "[workspace]") {
    const Folder folder;
    const std::string alone = folder.write("a.modx", kMain);
    folder.write("b.modx", kWork);
    Workspace workspace(kEnvironment);
    Program* program = workspace.programOf(alone);
    REQUIRE(program);
    CHECK(program->root() == alone);
    workspace.setFolders({folder.path});
    CHECK(workspace.programOf(alone)->root() == folder.path);
}

TEST_CASE("modules below a folder that its program does not have are judged with their own folder",
          "[workspace]") {
    const Folder folder;
    folder.write("a.modx", kMain);
    folder.write("b.modx", kWork);
    const std::string below =
        folder.write("tests/c.modx", "MODULE c\n  PROC main()\n    more;\n  ENDPROC\nENDMODULE\n");
    folder.write("tests/d.modx", "MODULE d\n  PROC more()\n  ENDPROC\nENDMODULE\n");
    Workspace workspace(kEnvironment);
    workspace.setFolders({folder.path});
    Program* program = workspace.programOf(below);
    REQUIRE(program);
    CHECK(program->root() == folder.path + "/tests");
    CHECK(program->diagnostics().empty());
}

TEST_CASE("warning settings change what is said", "[workspace]") {
    const Folder folder;
    const std::string path =
        folder.write("a.modx", "MODULE a\n  PROC main()\n    VAR num spare;\n  ENDPROC\nENDMODULE\n");
    Workspace workspace(kEnvironment);
    workspace.setFolders({folder.path});
    REQUIRE(workspace.programOf(path)->diagnostics().size() == 1);
    workspace.setWarnings({"no-unused-variable"});
    CHECK(workspace.programOf(path)->diagnostics().empty());
    workspace.setWarnings({"error=unused-variable", "no such warning"});
    CHECK(workspace.programOf(path)->diagnostics().front().severity == diag::Severity::Error);
    CHECK(workspace.programOf(path)->loaded().usageErrors.size() == 1);
    folder.write("rapidc.json", R"({"warnings": {"unused-variable": "off"}})");
    workspace.setWarnings({});
    workspace.fileChanged(folder.path + "/rapidc.json");
    CHECK(workspace.programOf(path)->diagnostics().empty());
}
