// A session's answer after each change must be that of a check of everything: random edits over many modules.

#include "sema_testing.h"

#include "frontend/diag/messages/names.h"
#include "frontend/sema/session.h"
#include "frontend/syntax/tree_walk.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <random>

using namespace rapid;
using namespace rapid::sema;
using namespace rapid::sema::testing;

namespace {

// ---- What is compared ------------------------------------------------------------------------------------------

std::string show(const diag::Diagnostic& d) {
    std::string out = diag::codeName(d.code) + " " + (d.file ? d.file->path() : "-") + ":" +
                      std::to_string(d.range.begin) + "-" + std::to_string(d.range.end) + " " + d.message;
    for (const auto& note : d.notes)
        out += "\n    " + note.file->path() + ":" + std::to_string(note.range.begin) + " " + note.message;
    for (const auto& fix : d.fixes)
        out += "\n    fix: " + fix.message;
    return out + "\n";
}

std::string show(const std::vector<diag::Diagnostic>& diagnostics) {
    std::string out;
    for (const diag::Diagnostic& d : diagnostics)
        out += show(d);
    return out;
}

std::string show(const ConstValue& value) {
    switch (value.kind) {
    case ConstValue::Kind::None: return "-";
    case ConstValue::Kind::Number: return std::to_string(value.number);
    case ConstValue::Kind::Bool: return value.boolean ? "TRUE" : "FALSE";
    case ConstValue::Kind::String: return '"' + std::string(value.text()) + '"';
    case ConstValue::Kind::Aggregate: break;
    }
    std::string out = "[";
    for (const ConstValue& member : value.members())
        out += show(member) + ",";
    return out + "]";
}

std::string show(const DataType& type) {
    std::string out = type.type->name + ":" + std::to_string(static_cast<int>(type.type->kind));
    for (int i = 0; i < type.rank; ++i)
        out += "," + std::to_string(type.dims[i]);
    for (const Type::Component& part : type.type->components)
        out += "." + part.name + ":" + part.type->name;
    return out;
}

std::string place(const Symbol* symbol) {
    if (!symbol) return "-";
    return symbol->name + "@" + (symbol->module ? symbol->module->name : "") + ":" +
           std::to_string(symbol->nameToken);
}

std::string show(const DataSymbol& data) {
    return place(&data) + " " + show(data.type) + " " + show(data.value()) + (data.used ? " used" : "") +
           (data.assigned ? " assigned" : "") + " " + std::to_string(data.index) + "\n";
}

void showFacts(const Module& module, const syntax::Node& node, std::string& out) {
    const FileFacts& facts = *module.facts;
    if (syntax::isExpr(node.kind)) {
        const ExprInfo& info = facts.exprs[syntax::as<syntax::Expr>(node).id];
        out += std::to_string(node.first) + " " + show(info.type()) + " " + place(info.symbol) + " " +
               (info.constant ? show(*info.constant) : "") + "\n";
    }
    if (const auto call = facts.calls.find(&node); call != facts.calls.end()) {
        out += "call " + place(call->second.routine) + " from " + call->second.module->name;
        for (const BoundArg& arg : call->second.args)
            out += " " + place(arg.param) + "=" + std::to_string(static_cast<int>(arg.kind)) + "/" +
                   std::to_string(arg.value ? arg.value->first : 0);
        out += "\n";
    }
    if (const auto to = facts.references.find(&node); to != facts.references.end())
        out += "refers to " + place(to->second) + "\n";
    if (node.kind == syntax::NodeKind::For)
        if (const auto var = facts.loopVariables.find(&syntax::as<syntax::ForStmt>(node));
            var != facts.loopVariables.end())
            out += "loop " + place(var->second) + "\n";
    syntax::forEachChild(node, [&](const syntax::Node& child) { showFacts(module, child, out); });
}

std::string show(const CheckedProgram& program) {
    std::string out;
    for (const auto& task : program.tasks) {
        out += task->name + " entry " + place(task->entryRoutine) + "\n";
        for (const DataSymbol* signal : task->signals)
            out += "signal " + show(*signal);
        for (const Module* module : task->modules) {
            out += "module " + module->name + "\n";
            for (const TypeSymbol* type : module->types)
                out += place(type) + (type->used ? " used " : " ") + show({type->type, 0, {}}) + "\n";
            for (const DataSymbol* data : module->data)
                out += show(*data);
            for (const RoutineSymbol* routine : module->routines) {
                out += place(routine) + (routine->used ? " used\n" : "\n");
                for (const DataSymbol* param : routine->params)
                    out += "  " + show(*param);
                for (const DataSymbol* data : routine->data)
                    out += "  " + show(*data);
            }
            showFacts(*module, *module->decl, out);
        }
    }
    for (const Module* module : program.predefinedModules)
        for (const RoutineSymbol* routine : module->routines)
            if (routine->used) out += "used " + routine->name + "\n";
    return out;
}

/// The first line that differs, with the one before it.
std::string firstDifference(const std::string& a, const std::string& b) {
    const size_t at =
        static_cast<size_t>(std::mismatch(a.begin(), a.end(), b.begin(), b.end()).first - a.begin());
    const size_t line = a.rfind('\n', at ? at - 1 : 0);
    const size_t from = line == std::string::npos ? 0 : line;
    return "session: " + a.substr(from, 400) + "\ncheck: " + b.substr(std::min(from, b.size()), 400);
}

// ---- Edits -----------------------------------------------------------------------------------------------------

using Random = std::mt19937;

size_t below(Random& random, size_t n) {
    return n == 0 ? 0 : random() % n;
}

std::vector<std::string> splitLines(const std::string& text) {
    std::vector<std::string> lines;
    for (size_t from = 0; from < text.size();) {
        const size_t end = std::min(text.find('\n', from), text.size() - 1);
        lines.push_back(text.substr(from, end + 1 - from));
        from = end + 1;
    }
    return lines;
}

/// A word, number or sign somewhere in the text: offset and length.
std::pair<size_t, size_t> anyWord(Random& random, const std::string& text) {
    const auto isWord = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_'; };
    size_t at = below(random, text.size());
    while (at < text.size() && std::isspace(static_cast<unsigned char>(text[at])))
        ++at;
    if (at >= text.size()) return {0, 0};
    size_t end = at + 1;
    if (isWord(text[at])) {
        while (at > 0 && isWord(text[at - 1]))
            --at;
        while (end < text.size() && isWord(text[end]))
            ++end;
    }
    return {at, end - at};
}

std::string edit(Random& random, const std::string& text, const std::vector<std::string>& others) {
    std::vector<std::string> lines = splitLines(text);
    const std::string& other = others[below(random, others.size())];
    const std::vector<std::string> otherLines = splitLines(other);
    const size_t at = below(random, lines.size());
    const auto join = [&] {
        std::string out;
        for (const std::string& line : lines)
            out += line;
        return out;
    };
    if (lines.empty() || otherLines.empty()) return other;
    std::string out = text;
    switch (below(random, 7)) {
    case 0: lines.erase(lines.begin() + static_cast<std::ptrdiff_t>(at)); return join();
    case 1: // a line of some file
        lines.insert(lines.begin() + static_cast<std::ptrdiff_t>(at),
                     otherLines[below(random, otherLines.size())]);
        return join();
    case 2: std::swap(lines[at], lines[below(random, lines.size())]); return join();
    case 3: { // a word of some file
        const auto [place, length] = anyWord(random, out);
        const auto [from, size] = anyWord(random, other);
        return out.replace(place, length, other.substr(from, size));
    }
    case 4: { // a name changes its case: nothing must change but spellings
        const auto [place, length] = anyWord(random, out);
        for (size_t i = place; i < place + length; ++i)
            out[i] = static_cast<char>(std::toupper(static_cast<unsigned char>(out[i])));
        return out;
    }
    case 5: return out.insert(below(random, out.size()), 1, ";,()[]:=!\"x1 \n"[below(random, 14)]);
    default: lines.insert(lines.begin() + static_cast<std::ptrdiff_t>(at), "! remark\n"); return join();
    }
}

// ---- The comparison --------------------------------------------------------------------------------------------

using Editor = std::string (*)(Random&, const std::string&, const std::vector<std::string>&);

/// A change as editors send it: the text at once, or first for an answer at a place in it, maybe with a text between.
void change(Session& session, Random& random, const std::shared_ptr<const SourceFile>& file,
            const std::string& before) {
    const std::string now(file->text());
    const size_t way = below(random, 4);
    session.setLargeFrom(below(random, 2) == 0 ? 0 : SIZE_MAX); // whether other files wait
    if (way == 3) {                                             // half of the new text: what is typed next
        const std::string half = now.substr(0, now.size() / 2) + before.substr(before.size() / 2);
        const auto typed = std::make_shared<const SourceFile>(file->path(), half);
        session.sketch(typed, static_cast<uint32_t>(below(random, half.size() + 1)));
    }
    if (way == 0 || !session.sketch(file, static_cast<uint32_t>(below(random, now.size() + 1))))
        REQUIRE(session.change(file));
    session.complete();
    REQUIRE(session.isComplete());
}

/// Changes one file after the other and compares each time. Files: path -> text, for each task.
void compareThroughEdits(const std::vector<std::map<std::string, std::string>>& tasks,
                         const CheckOptions& options, unsigned seed, int steps, Editor editor = edit) {
    Random random(seed);
    std::map<std::string, std::string> now;
    std::vector<std::string> originals;
    for (const auto& files : tasks)
        now.insert(files.begin(), files.end());
    const std::map<std::string, std::string> first = now;
    std::map<std::string, std::shared_ptr<const SourceFile>> sources;
    for (const auto& [path, text] : now) {
        originals.push_back(text);
        sources[path] = std::make_shared<const SourceFile>(path, text);
    }
    const auto inputs = [&] {
        std::vector<TaskInput> all;
        for (const auto& files : tasks) {
            TaskInput& input = all.emplace_back();
            input.name = "T_ROB" + std::to_string(all.size());
            for (const auto& [path, text] : files)
                input.files.push_back(sources[path]);
        }
        return all;
    };
    Session session(options);
    session.open(inputs());
    Random ways(seed + 1000);
    for (int step = 0; step < steps; ++step) {
        auto at = now.begin();
        std::advance(at, below(random, now.size()));
        // Back to the beginning from time to time, lest only rubble is compared.
        const bool heal = below(random, 3) == 0;
        if (heal)
            for (const auto& [path, text] : first)
                if (now[path] != text) at = now.find(path);
        const std::string before = at->second;
        at->second = heal ? first.at(at->first) : editor(random, at->second, originals);
        sources[at->first] = std::make_shared<const SourceFile>(at->first, at->second);
        change(session, ways, sources[at->first], before);

        diag::Sink sink;
        const auto program = check(inputs(), options, sink);
        const std::string expected = show(sink.sorted()), found = show(session.diagnostics());
        const std::string facts = show(*program), foundFacts = show(session.program());
        if (expected == found && facts == foundFacts) continue;
        INFO("seed " << seed << ", step " << step << ", changed " << at->first << "\n"
                     << at->second << "\nbefore:\n"
                     << before);
        INFO((expected != found ? firstDifference(found, expected) : firstDifference(foundFacts, facts)));
        FAIL("the session and the check of everything do not agree");
    }
}

int steps(int otherwise) {
    const char* given = std::getenv("RAPIDC_SESSION_STEPS");
    return given ? std::atoi(given) : otherwise;
}

/// A text without syntax errors: one line that can be left out is put in, taken out, or exchanged.
std::string editLine(Random& random, const std::string& text, const std::vector<std::string>&) {
    static const std::vector<std::string> inside = {
        "missing := 1;",
        "missing := other;",
        "speddHigh := 2;",
        "speedHigh := 2;",
        "hidden := 3;",
        "hiddenToo := 3;",
        "absent;",
        "TPWrite lost;",
        "WaitDI diPart, 1;",
        "diPart := 1;",
        "IF flagged = 1 Stop;",
        "flagged := flagged + 0.5;",
        "TPWrite \"a\" \\Num:=speedHigh;",
        "RETURN;",
        "helper;",
    };
    static const std::vector<std::string> outside = {"LOCAL VAR num hidden;", "LOCAL PROC helper() ENDPROC",
                                                     "LOCAL VAR string hidden;", "VAR num lost;"};
    std::vector<std::string> lines = splitLines(text);
    const bool atTop = below(random, 4) == 0;
    const std::string mark = atTop ? "! outside\n" : "! inside\n";
    const std::vector<std::string>& choices = atTop ? outside : inside;
    std::vector<size_t> places;
    for (size_t i = 0; i < lines.size(); ++i)
        if (lines[i].ends_with(mark)) places.push_back(i);
    const std::string line = below(random, 3) == 0 ? "" : choices[below(random, choices.size())];
    lines[places[below(random, places.size())]] = line + " " + mark;
    std::string out;
    for (const std::string& each : lines)
        out += each;
    return out;
}

const std::map<std::string, std::string> kCell = {
    {"a_types.sysx", R"(MODULE Types(SYSMODULE)
  RECORD part
    num weight;
    pos place;
    string name;
  ENDRECORD
  ALIAS num level;
  LOCAL CONST num base := 4;
  CONST num slots := base * 2;
  CONST part nothing := [0, [0, 0, 0], ""];
  PERS tooldata grip := [TRUE, [[0, 0, 100], [1, 0, 0, 0]], [1, [0, 0, 50], [1, 0, 0, 0], 0, 0, 0]];
  CONST num table{3} := [1, 2, 3];
ENDMODULE
)"},
    {"b_main.modx", R"(MODULE MainModule
  PERS num count := 0;
  VAR part stock{slots};
  PROC main()
    VAR level high := 3;
    FOR i FROM 1 TO slots DO
      stock{i} := nothing;
      fetch stock{i}, high \fast;
    ENDFOR
    IF total() > table{2} stopAll;
    WaitDI diReady, 1;
    SetDO doClamp, 1;
  ERROR
    TRYNEXT;
  ENDPROC
  LOCAL PROC stopAll()
    TPWrite "stop" \Num:=count;
    goto done;
  done:
    count := 0;
  ENDPROC
ENDMODULE
)"},
    {"c_work.modx", R"(MODULE Work
  CONST robtarget home := [[600, 0, 700], [1, 0, 0, 0], [0, 0, 0, 0], [9E9, 9E9, 9E9, 9E9, 9E9, 9E9]];
  LOCAL VAR num calls;
  PROC fetch(INOUT part one, num speed \switch fast | num slow)
    calls := calls + 1;
    one.weight := slots;
    one.place := home.trans;
    IF Present(slow) one.weight := slow;
    MoveL Offs(home, 0, 0, speed), v500, z10, grip;
    IF diReady = 1 count := count + 1;
  ENDPROC
  FUNC num total()
    VAR num sum := 0;
    FOR i FROM 1 TO Dim(stock, 1) DO
      sum := sum + stock{i}.weight;
    ENDFOR
    RETURN sum;
  ENDFUNC
ENDMODULE
)"},
    {"d_traps.modx", R"(MODULE Traps
  VAR intnum alarm;
  CONST num limit := table{3} + slots;
  TRAP onAlarm
    count := limit;
    doUnknown 5;
  ENDTRAP
  PROC connectAll()
    CONNECT alarm WITH onAlarm;
    ISignalDI diReady, 1, alarm;
    TEST count
    CASE slots, 3:
      fetch stock{1}, limit \slow:=home.trans.x;
    DEFAULT:
      %"connectAll"%;
    ENDTEST
  ENDPROC
ENDMODULE
)"},
    {"e_more.modx", R"(MODULE More
  TASK PERS num only := 1;
  LOCAL CONST part sample := [1, [1, 2, 3], "sample"];
  CONST part given := sample;
  RECORD box
    part inside;
    level depth;
  ENDRECORD
  VAR box crate;
  FUNC bool heavy(box b \num than)
    IF Present(than) RETURN b.inside.weight > than;
    RETURN b.inside.weight > given.weight;
  ENDFUNC
  PROC fill()
    crate.inside := given;
    IF heavy(crate \than:=limit) count := only;
  ENDPROC
ENDMODULE
)"},
};

} // namespace

TEST_CASE("a session says after each edit what a check of everything says", "[session]") {
    CheckOptions options;
    options.library = library();
    for (unsigned seed = 1; seed <= 3; ++seed)
        compareThroughEdits({kCell}, options, seed, steps(60));
}

TEST_CASE("a session with known signals and shared modules in two tasks", "[session]") {
    CheckOptions options;
    options.library = library();
    options.configurationKnown = true;
    options.signals = {{"diReady", "signaldi"}, {"doClamp", "signaldo"}};
    std::map<std::string, std::string> second = {{"a_types.sysx", kCell.at("a_types.sysx")},
                                                 {"x_other.modx", R"(MODULE Other
  PERS num count;
  PROC main()
    count := slots;
    SetDO doClamp, 0;
    WaitDI diReady, 1;
  ENDPROC
ENDMODULE
)"}};
    for (unsigned seed = 11; seed <= 12; ++seed)
        compareThroughEdits({kCell, second}, options, seed, steps(60));
}

// Files with undeclared names stay as they are when another file changes in nothing that they can notice: how often names are
// used, what is LOCAL, and how undeclared names are used count.
TEST_CASE("a session whose files use undeclared names", "[session]") {
    CheckOptions options;
    options.library = library();
    std::map<std::string, std::string> files;
    for (const char* const name : {"A", "B", "C", "D"}) {
        std::string& text = files[std::string(name) + ".modx"];
        text = std::string("MODULE ") + name + "\n! outside\n! outside\n";
        if (*name == 'A') text += "VAR num speedHigh;\n";
        for (const char* const routine : {"first", "second"})
            text += std::string("PROC ") + routine + name +
                    "()\n missing := 1; ! inside\n ! inside\n ! inside\n ! inside\nENDPROC\n";
        text += "ENDMODULE\n";
    }
    for (const bool known : {false, true}) {
        options.configurationKnown = known;
        for (unsigned seed = 31; seed <= 34; ++seed)
            compareThroughEdits({files}, options, seed, steps(60), editLine);
    }
}

// The programs that show mistakes hold every construct that the checker has an opinion on.
TEST_CASE("a session with programs full of mistakes", "[session]") {
    namespace fs = std::filesystem;
    CheckOptions options;
    options.library = library();
    std::vector<std::string> paths;
    for (const auto& entry : fs::recursive_directory_iterator(fs::path(RAPIDC_SOURCE_DIR) / "tests" / "diag"))
        if (entry.path().extension() == ".modx") paths.push_back(entry.path().string());
    REQUIRE(paths.size() > 50);
    std::sort(paths.begin(), paths.end());
    for (unsigned seed = 21; seed <= 23; ++seed) {
        Random random(seed);
        std::map<std::string, std::string> files = kCell;
        for (int i = 0; i < 8; ++i) {
            const std::string& path = paths[below(random, paths.size())];
            std::string text = readFile(path);
            const size_t name = text.find("MODULE ");
            if (name != std::string::npos) text.insert(name + 7, "X" + std::to_string(i));
            files[fs::path(path).filename().string()] = text;
        }
        compareThroughEdits({files}, options, seed, steps(40));
    }
}

TEST_CASE("a session takes no file that it does not know", "[session]") {
    CheckOptions options;
    options.library = library();
    Session session(options);
    TaskInput input;
    input.files.push_back(std::make_shared<const SourceFile>("a.modx", "MODULE a\nENDMODULE\n"));
    session.open({input});
    CHECK_FALSE(session.change(std::make_shared<const SourceFile>("b.modx", "MODULE b\nENDMODULE\n")));
    CHECK(
        session.change(std::make_shared<const SourceFile>("a.modx", "MODULE a\n  VAR nix n;\nENDMODULE\n")));
    REQUIRE(session.diagnostics().size() == 1);
    CHECK(session.diagnostics()[0].code == diag::say::UnknownType.code);
}
