// Shapes of trees: what binds to what, and what belongs to which node.

#include "syntax_test.h"

#include "frontend/syntax/tree_walk.h"

#include <catch2/catch.hpp>

using namespace rapid;
using test::inProcedure;
using test::parseText;
using namespace rapid::syntax;

namespace {

const char* const kOps[] = {
    "+", "-", "*", "/", "DIV", "MOD", "<", "<=", "=", "<>", ">", ">=", "AND", "OR", "XOR"};

/// An expression with all its structure in parentheses: "(a + (b * c))".
std::string show(const SyntaxTree& tree, const Expr& e) {
    switch (e.kind) {
    case NodeKind::Binary: {
        const auto& n = as<BinaryExpr>(e);
        return "(" + show(tree, *n.left) + " " + kOps[static_cast<int>(n.op)] + " " + show(tree, *n.right) +
               ")";
    }
    case NodeKind::Unary: {
        const auto& n = as<UnaryExpr>(e);
        const char* ops[] = {"+", "-", "NOT "};
        return "(" + std::string(ops[static_cast<int>(n.op)]) + show(tree, *n.operand) + ")";
    }
    case NodeKind::Paren: return "<" + show(tree, *as<ParenExpr>(e).inner) + ">";
    default: return std::string(tree.text(e.first));
    }
}

std::string shape(const std::string& expression) {
    const test::Parsed parsed = parseText(inProcedure("x := " + expression + ";"));
    if (parsed.sink.hasErrors()) return parsed.codes();
    const auto& routine = as<RoutineDecl>(*parsed.tree->modules[0]->decls[0]);
    return show(*parsed.tree, *as<AssignStmt>(*routine.body[0]).value);
}

const RoutineDecl& routineOf(const test::Parsed& parsed, size_t index = 0) {
    return as<RoutineDecl>(*parsed.tree->modules.at(0)->decls[index]);
}

} // namespace

TEST_CASE("priority of operators, manual 1.3.5", "[syntax][tree]") {
    CHECK(shape("a+b+c") == "((a + b) + c)");
    CHECK(shape("a+b*c") == "(a + (b * c))");
    CHECK(shape("a OR b OR c") == "((a OR b) OR c)");
    CHECK(shape("a AND b OR c AND d") == "((a AND b) OR (c AND d))");
    CHECK(shape("a<b AND c<d") == "((a < b) AND (c < d))");
    CHECK(shape("a OR b XOR c") == "((a OR b) XOR c)");
    CHECK(shape("a DIV b MOD c / d") == "(((a DIV b) MOD c) / d)");
    CHECK(shape("a-b-c") == "((a - b) - c)");
    CHECK(shape("(a+b)*c") == "(<(a + b)> * c)");
    CHECK(shape("a+1>=b*2") == "((a + 1) >= (b * 2))");
}

TEST_CASE("a sign covers the first term", "[syntax][tree]") {
    CHECK(shape("-a*b") == "(-(a * b))");
    CHECK(shape("-a+b") == "((-a) + b)");
    CHECK(shape("a < -b") == "(a < (-b))");
    CHECK(shape("a = 1 AND b = -1") == "((a = 1) AND (b = (-1)))");
    CHECK(shape("2*(-3)") == "(2 * <(-3)>)");
    CHECK(shape("2*-3") == "RAP1104@3:8");
}

TEST_CASE("NOT covers the logical term it begins, after AND one relation", "[syntax][tree]") {
    CHECK(shape("NOT a AND b") == "(NOT (a AND b))");
    CHECK(shape("NOT a OR b") == "((NOT a) OR b)");
    CHECK(shape("NOT a = b") == "(NOT (a = b))");
    CHECK(shape("a AND NOT b AND c") == "((a AND (NOT b)) AND c)");
    CHECK(shape("a AND NOT b = c") == "(a AND (NOT (b = c)))");
    CHECK(shape("a OR NOT b AND c") == "(a OR (NOT (b AND c)))");
    CHECK(shape("NOT NOT a") == "(NOT (NOT a))");
    CHECK(shape("(NOT a) AND b") == "(<(NOT a)> AND b)");
}

TEST_CASE("arguments of every kind", "[syntax][tree]") {
    const test::Parsed parsed = parseText(
        inProcedure("Foo a, Speed:=b \\On, \\Time:=3 \\Corr?corr, c;\nFoo \\x;\nFoo <ARG>, \\y?<VAR>;"));
    REQUIRE(parsed.codes().empty());
    const auto& call = as<CallStmt>(*routineOf(parsed).body[0]);
    REQUIRE(call.args.size() == 6);
    const ArgKind kinds[] = {ArgKind::Required, ArgKind::Required,    ArgKind::Optional,
                             ArgKind::Optional, ArgKind::Conditional, ArgKind::Required};
    const char* names[] = {"", "Speed", "On", "Time", "Corr", ""};
    for (size_t i = 0; i < 6; ++i) {
        CHECK(call.args[i]->argKind == kinds[i]);
        CHECK(parsed.tree->text(call.args[i]->name) == names[i]);
        CHECK((call.args[i]->value == nullptr) == (i == 2));
    }
    CHECK(as<CallStmt>(*routineOf(parsed).body[2]).args[0]->argKind == ArgKind::Placeholder);
}

TEST_CASE("BREAK and CONTINUE may name arguments and parameters", "[syntax][tree]") {
    CHECK(parseText(inProcedure("RaiseToUser \\Continue \\ErrorNumber:=1;\nRaiseToUser \\BreakOff;"))
              .codes()
              .empty());
    CHECK(parseText("MODULE m\nPROC p(\\switch Continue | switch Break)\nENDPROC\nENDMODULE\n")
              .codes()
              .empty());
}

TEST_CASE("TASK and switch are words only where the grammar has them", "[syntax][tree]") {
    const test::Parsed parsed =
        parseText("MODULE m\nTASK VAR num a;\ntask PERS num b := 1;\nVAR num switch;\n"
                  "VAR num task;\nPROC p(\\switch on, num switch)\nswitch := 1;\ntask := switch;\n"
                  "switch 1;\nENDPROC\nENDMODULE\n");
    INFO(parsed.shown());
    REQUIRE(parsed.codes().empty());
    const auto decls = parsed.tree->modules[0]->decls;
    CHECK(as<DataDecl>(*decls[0]).scope == ScopeWord::Task);
    CHECK(as<DataDecl>(*decls[1]).scope == ScopeWord::Task);
    CHECK(as<DataDecl>(*decls[2]).scope == ScopeWord::None);
    const auto& routine = routineOf(parsed, 4);
    REQUIRE(routine.params.size() == 2);
    CHECK(routine.params[0]->isSwitch);
    CHECK_FALSE(routine.params[1]->isSwitch);
    CHECK(routine.body.size() == 3);
}

TEST_CASE("groups of parameters", "[syntax][tree]") {
    const test::Parsed parsed = parseText("MODULE m\nPROC p(num a, VAR num b{*,*} \\num c | PERS num d | "
                                          "switch e, \\INOUT num f, <PAR> \\<ALT>,"
                                          " bool g{<DIM>})\nENDPROC\nENDMODULE\n");
    INFO(parsed.shown());
    REQUIRE(parsed.codes().empty());
    const auto params = routineOf(parsed).params;
    REQUIRE(params.size() == 9);
    const uint32_t groups[] = {0, 1, 2, 2, 2, 3, 4, 5, 6};
    const bool optional[] = {false, false, true, true, true, true, false, true, false};
    for (size_t i = 0; i < 9; ++i) {
        CHECK(params[i]->group == groups[i]);
        CHECK(params[i]->optional == optional[i]);
        CHECK(params[i]->placeholder == (i == 6 || i == 7));
    }
    CHECK(params[1]->rank == 2);
    CHECK(params[1]->mode == ParamMode::Var);
    CHECK(params[3]->mode == ParamMode::Pers);
    CHECK(params[4]->isSwitch);
    CHECK(params[5]->mode == ParamMode::Inout);
    CHECK(params[8]->rank == 255);
}

TEST_CASE("declarations of built-ins have no body, REF, and alternatives without '\\'", "[syntax][tree]") {
    const std::string text = "MODULE m\n"
                             "  !! Adds.\n  !@ lower: x\n"
                             "  PROC Add(INOUT num Name | INOUT dnum Dname, num Value) ! trailing\n"
                             "  !! Sizes.\n"
                             "  FUNC num Dim(REF anytype Array, num No)\n"
                             "  TRAP t\n"
                             "  RECORD handle\n  ENDRECORD\n"
                             "  PROC WithBody()\n    VAR num a;\n    a := 1;\n  ENDPROC\n"
                             "  LOCAL PROC Native(\\num T | \\num V)\n"
                             "ENDMODULE\n";
    const test::Parsed parsed = parseText(text, true);
    INFO(parsed.shown());
    REQUIRE(parsed.codes().empty());
    const auto decls = parsed.tree->modules[0]->decls;
    REQUIRE(decls.size() == 6);
    CHECK_FALSE(as<RoutineDecl>(*decls[0]).hasBody);
    CHECK(as<RoutineDecl>(*decls[0]).params[1]->group == 0);
    CHECK(as<RoutineDecl>(*decls[0]).params[2]->group == 1);
    CHECK(as<RoutineDecl>(*decls[1]).params[0]->mode == ParamMode::Ref);
    CHECK_FALSE(as<RoutineDecl>(*decls[2]).hasBody);
    CHECK(as<RoutineDecl>(*decls[4]).hasBody);
    CHECK(as<RoutineDecl>(*decls[4]).data.size() == 1);
    CHECK(as<RoutineDecl>(*decls[5]).params[1]->optional);
    CHECK(leadingTrivia(*parsed.tree, *decls[0]) == "  !! Adds.\n  !@ lower: x\n  ");
    CHECK(leadingTrivia(*parsed.tree, *decls[1]) == "  !! Sizes.\n  ");
    CHECK_FALSE(parseText(text).codes().empty());
}

TEST_CASE("handlers of a routine", "[syntax][tree]") {
    const test::Parsed parsed = parseText(inProcedure(
        "x := 1;\nBACKWARD\nx := 2;\nERROR (ERR_A, 5)\nRETRY;\nERROR\nTRYNEXT;\nRAISE;\nUNDO\nEXIT;"));
    REQUIRE(parsed.codes().empty());
    const RoutineDecl& routine = routineOf(parsed);
    CHECK(routine.body.size() == 1);
    CHECK(routine.hasBackward);
    CHECK(routine.backward.size() == 1);
    REQUIRE(routine.errors.size() == 2);
    CHECK(routine.errors[0]->hasList);
    CHECK(routine.errors[0]->numbers.size() == 2);
    CHECK_FALSE(routine.errors[1]->hasList);
    CHECK(routine.errors[1]->body.size() == 2);
    CHECK(routine.hasUndo);
}

TEST_CASE("a compact IF takes one instruction, on this line or the next", "[syntax][tree]") {
    const test::Parsed parsed = parseText(inProcedure(
        "IF a x := 1;\nIF a\n  GOTO l;\nIF a IF b Stop;\nIF a <SMT>\nIF a IF b THEN\nENDIF\nl:\nx := 2;"));
    REQUIRE(parsed.codes().empty());
    const auto body = routineOf(parsed).body;
    REQUIRE(body.size() == 7);
    CHECK(as<CompactIfStmt>(*body[0]).body->kind == NodeKind::Assign);
    CHECK(as<CompactIfStmt>(*body[1]).body->kind == NodeKind::Goto);
    CHECK(as<CompactIfStmt>(*body[2]).body->kind == NodeKind::CompactIf);
    CHECK(as<CompactIfStmt>(*body[3]).body->kind == NodeKind::PlaceholderStmt);
    CHECK(as<CompactIfStmt>(*body[4]).body->kind == NodeKind::If);
    CHECK(body[5]->kind == NodeKind::Label);
}

TEST_CASE("late binding", "[syntax][tree]") {
    const test::Parsed parsed =
        parseText(inProcedure("%\"proc\"+NumToStr(i,0)% x, y;\n% procname{i} %;\nIF a %\"p\"% \\s;"));
    REQUIRE(parsed.codes().empty());
    const auto body = routineOf(parsed).body;
    const auto& call = as<CallStmt>(*body[0]);
    CHECK(call.name == kNoToken);
    REQUIRE(call.lateName != nullptr);
    CHECK(call.lateName->kind == NodeKind::Binary);
    CHECK(call.args.size() == 2);
    CHECK(as<CallStmt>(*body[1]).lateName->kind == NodeKind::Index);
}

TEST_CASE("placeholders stand for every part", "[syntax][tree]") {
    const test::Parsed parsed =
        parseText("MODULE <ID>\n<TDN>\n<DDN>\nVAR num <ID>;\n<RDN>\nPROC p(<PAR> \\<ALT>)\n<DDN>\nVAR num "
                  "a;\n<SMT>\n<VAR> := <EXP>;\n"
                  "IF <EXP> THEN\n<EIT>\nELSE\nENDIF\nTEST a\n<CSE>\nCASE <EXP>:\nENDTEST\nFoo <ARG>, "
                  "<EXP>;\n<ID> 1;\nENDPROC\nENDMODULE\n");
    INFO(parsed.shown());
    REQUIRE(parsed.codes().empty());
    CHECK(parsed.tree->modules[0]->decls.size() == 5);
}

TEST_CASE("order of module parts is free, comments stand anywhere", "[syntax][tree]") {
    const test::Parsed parsed =
        parseText("! before\nMODULE m ! after\n! one\nPROC a()\n! two\nENDPROC\nVAR num b;\nALIAS num c;\n"
                  "! three\nRECORD d\n! four\nnum e;\nENDRECORD\nENDMODULE\n! end");
    CHECK(parsed.sink.errorCount() == 0);
    CHECK(parsed.tree->modules[0]->decls.size() == 4);
}

TEST_CASE("expressions are numbered densely", "[syntax][tree]") {
    const test::Parsed parsed = parseText(inProcedure("x{1} := f(a, [1, -b], c.d) + (2);"));
    std::vector<bool> seen(parsed.tree->exprCount, false);
    const std::function<void(const Node&)> walk = [&](const Node& node) {
        if (isExpr(node.kind)) {
            REQUIRE(static_cast<const Expr&>(node).id < seen.size());
            seen[static_cast<const Expr&>(node).id] = true;
        }
        forEachChild(node, walk);
    };
    walk(*parsed.tree->modules[0]);
    for (const bool was : seen)
        CHECK(was);
}

TEST_CASE("an expression alone", "[syntax][tree]") {
    const auto parse = [](const char* text) {
        diag::Sink sink;
        const ParsedExpr parsed = parseExpression(std::make_shared<const SourceFile>("value", text), sink);
        REQUIRE(parsed.expr != nullptr);
        CHECK(printSource(*parsed.tree) == parsed.tree->source->text());
        return sink.all().empty() ? show(*parsed.tree, *parsed.expr) : codeName(sink.all()[0].code);
    };
    CHECK(parse("a + 2 * b") == "(a + (2 * b))");
    CHECK(parse(" -1 ") == "(-1)");
    CHECK(parse("[1,[2,3],\"x\"]") == "[");
    CHECK(parse("") == "RAP1101");
    CHECK(parse("1 2") == "RAP1101");
    CHECK(parse("1;") == "RAP1101");
    CHECK(parse("(1") == "RAP1103");
    CHECK(parse("\"a") == "RAP1006");
}

TEST_CASE("positions of tokens in several lines", "[syntax][tree]") {
    const test::Parsed parsed = parseText("MODULE é ! c\r\n\tVAR num a;\rENDMODULE\n\n");
    CHECK(printTokens(*parsed.tree) ==
          "1:1 KwModule MODULE\n1:8 Identifier é\n2:2 KwVar VAR\n2:6 Identifier num\n"
          "2:10 Identifier a\n2:11 Semicolon ;\n3:1 KwEndmodule ENDMODULE\n5:1 EndOfFile\n");
}

TEST_CASE("printed forms", "[syntax][tree]") {
    const test::Parsed parsed = parseText(
        "MODULE m(SYSMODULE)\n  LOCAL CONST num a{2} := [1, .5];\n  FUNC bool f(num b)\n"
        "    FOR i FROM 1 TO 2 STEP 1 DO\n      Foo \\x:=\"s\";\n    ENDFOR\n    RETURN NOT b > a{1};\n"
        "  ERROR\n    RETRY;\n  ENDFUNC\nENDMODULE\n");
    REQUIRE(parsed.codes().empty());
    CHECK(printTree(*parsed.tree) == "Module m SYSMODULE\n"
                                     "  Data LOCAL CONST num a\n"
                                     "    dim: NumLiteral 2\n"
                                     "    Aggregate\n"
                                     "      NumLiteral 1\n"
                                     "      NumLiteral 0.5 decimal\n"
                                     "  Routine FUNC bool f\n"
                                     "    Param num b group 0\n"
                                     "    Body\n"
                                     "      For i\n"
                                     "        from: NumLiteral 1\n"
                                     "        to: NumLiteral 2\n"
                                     "        step: NumLiteral 1\n"
                                     "        CallStmt Foo\n"
                                     "          Argument \\x :=\n"
                                     "            StringLiteral \"s\"\n"
                                     "      Return\n"
                                     "        Unary NOT\n"
                                     "          Binary >\n"
                                     "            Name b\n"
                                     "            Index\n"
                                     "              Name a\n"
                                     "              NumLiteral 1\n"
                                     "    ErrorClause\n"
                                     "      Retry\n");
    const test::Parsed tokens = parseText("MODULE m\nENDMODULE");
    CHECK(printTokens(*tokens.tree) ==
          "1:1 KwModule MODULE\n1:8 Identifier m\n2:1 KwEndmodule ENDMODULE\n2:10 EndOfFile\n");
}
