// Aggregates of literals whose elements are made when they are asked for: nobody can tell them from others.

#include "syntax_test.h"

#include "frontend/syntax/tree_walk.h"

#include <catch2/catch.hpp>

#include <functional>
#include <set>

using namespace rapid;
using test::inProcedure;
using test::parseText;
using namespace rapid::syntax;

namespace {

test::Parsed parseWhole(std::string text) {
    test::Parsed result;
    ParseOptions options;
    options.wholeAggregates = true;
    auto source = std::make_shared<const SourceFile>("test.modx", std::move(text));
    result.tree = parse(std::move(source), result.sink, options);
    return result;
}

std::string moduleData(const std::string& value) {
    return "MODULE m\nCONST robtarget p:=" + value + ";\nCONST num after:=1;\nENDMODULE\n";
}

test::Parsed parseModuleData(const std::string& value) {
    return parseText(moduleData(value));
}

const Expr& initOf(const test::Parsed& parsed) {
    return *as<DataDecl>(*parsed.tree->modules.at(0)->decls.front()).init;
}

bool isPlain(const std::string& value) {
    const test::Parsed parsed = parseModuleData(value);
    const Expr& init = initOf(parsed);
    return init.kind == NodeKind::Aggregate && as<AggregateExpr>(init).isPlain();
}

/// Kinds, tokens and values of an expression and all its parts; tokens are counted from the first one.
std::string show(const SyntaxTree& tree, const Expr& e, TokenIndex base) {
    std::string out = std::string(nodeKindName(e.kind)) + " " + std::to_string(e.first - base) + "-" +
                      std::to_string(e.last - base);
    if (e.kind == NodeKind::NumLiteral) out += "=" + std::to_string(as<NumLiteralExpr>(e).value);
    if (e.kind == NodeKind::BoolLiteral) out += as<BoolLiteralExpr>(e).value ? "=TRUE" : "=FALSE";
    if (e.kind == NodeKind::StringLiteral) out += "=" + std::string(tree.text(e.first));
    forEachChild(e, [&](const Node& child) { out += " (" + show(tree, as<Expr>(child), base) + ")"; });
    return out;
}

void collectIds(const Node& node, std::multiset<uint32_t>& ids) {
    if (isExpr(node.kind)) ids.insert(as<Expr>(node).id);
    forEachChild(node, [&](const Node& child) { collectIds(child, ids); });
}

const char* const kPlain[] = {"[0]",
                              "[-1]",
                              "[[1,-2.5,3],[1,0,0,0],[-1,0,0,0],[9E9,9E+09,9e9,9E9,1.5E-12,0]]",
                              "[\"a\",TRUE,FALSE,\"]\"]",
                              "[ \"a\"\"b;\" ,\n ! comment\n [ true , - 7 ] ]",
                              "[.5,1.,999999999999]"};

} // namespace

TEST_CASE("a plain aggregate has the elements that any other one has", "[syntax][tree]") {
    for (const char* value : kPlain) {
        INFO(value);
        CHECK(isPlain(value));
        const test::Parsed module = parseModuleData(value);
        const test::Parsed routine = parseText(inProcedure("VAR robtarget p:=" + std::string(value) + ";"));
        REQUIRE(module.codes().empty());
        REQUIRE(routine.codes().empty());
        const Expr& plain = initOf(module);
        const Expr& other = *as<RoutineDecl>(*routine.tree->modules[0]->decls[0]).data[0]->init;
        CHECK_FALSE(as<AggregateExpr>(other).isPlain());
        CHECK(show(*module.tree, plain, plain.first) == show(*routine.tree, other, other.first));
        CHECK(as<AggregateExpr>(plain).isPlain()); // still, and the elements are the same ones
        CHECK(as<AggregateExpr>(plain).elements().data() == as<AggregateExpr>(plain).elements().data());
    }
}

TEST_CASE("the expressions of a plain aggregate are numbered as all others", "[syntax][tree]") {
    for (const bool whole : {false, true}) {
        const test::Parsed parsed = whole ? parseWhole(moduleData(kPlain[2])) : parseModuleData(kPlain[2]);
        std::multiset<uint32_t> ids;
        collectIds(*parsed.tree->modules[0], ids);
        const uint32_t count = parsed.tree->exprCount;
        CHECK(ids.size() == count);
        for (uint32_t id = 0; id < count; ++id)
            CHECK(ids.count(id) == 1);
    }
}

TEST_CASE("a plain aggregate that is one token has the same elements", "[syntax][tree]") {
    for (const char* value : kPlain) {
        INFO(value);
        for (const std::string& text :
             {moduleData(value), inProcedure("VAR pos p:=" + std::string(value) + ";"),
              inProcedure("p:=" + std::string(value) + " ;")}) {
            const test::Parsed usual = parseText(text), whole = parseWhole(text);
            CHECK(whole.codes().empty());
            CHECK(whole.tree->tokens.size() < usual.tree->tokens.size());
            CHECK(printSource(*whole.tree) == text);
            const ModuleDecl& module = *whole.tree->modules.at(0);
            std::string kinds, wanted;
            const std::function<void(const SyntaxTree&, const Node&, std::string&)> walk =
                [&](const SyntaxTree& tree, const Node& node, std::string& out) {
                    const SourceRange at = tree.range(node);
                    out += std::string(nodeKindName(node.kind)) + " " + std::to_string(at.begin) + "-" +
                           std::to_string(at.end) + "\n";
                    forEachChild(node, [&](const Node& child) { walk(tree, child, out); });
                };
            walk(*whole.tree, module, kinds);
            walk(*usual.tree, *usual.tree->modules.at(0), wanted);
            CHECK(kinds == wanted);
            CHECK(printSource(*whole.tree) == text); // also when the elements are made
        }
    }
}

TEST_CASE("a file with mistakes has all its tokens", "[syntax][tree]") {
    for (const std::string value : {"[1,2] 3", "[[1,2],[3,4]", "[1,2];;VAR", "[1,2]+[3]", "[1,-]", "[\"a]"}) {
        INFO(value);
        const test::Parsed usual = parseModuleData(value), whole = parseWhole(moduleData(value));
        CHECK(whole.codes() == usual.codes());
        CHECK(printTokens(*whole.tree) == printTokens(*usual.tree));
    }
}

TEST_CASE("an aggregate of more than literals is not plain", "[syntax][tree]") {
    for (const char* value : {"[1+1]", "[+5]", "[a]", "[(1)]", "[NOT TRUE]", "[-a]", "[f(1)]", "[1]+[2]",
                              "[0x10]", "[1E39]", "[9E99]", "[1234567890123]", "[1,<EXP>]", "5", "\"a\""}) {
        INFO(value);
        CHECK_FALSE(isPlain(value));
    }
    std::string deep;
    for (int i = 0; i < 500; ++i)
        deep += '[';
    deep += '1';
    for (int i = 0; i < 500; ++i)
        deep += ']';
    CHECK_FALSE(isPlain(deep));
}

TEST_CASE("mistakes in an aggregate of literals are reported in a module as in a routine", "[syntax][tree]") {
    for (const std::string value :
         {"[1,]", "[,1]", "[]", "[1 2]", "[1,[2]", "[1]]", "[--1]", "[\"a]", "[1,2", "[0x]"}) {
        INFO(value);
        const test::Parsed module = parseText("MODULE m\nLOCAL\nVAR pos p:=" + value + ";\nENDMODULE\n");
        const test::Parsed routine =
            parseText("MODULE m\nPROC main()\nVAR pos p:=" + value + ";\nENDPROC\nENDMODULE\n");
        CHECK_FALSE(module.codes().empty());
        CHECK(module.codes() == routine.codes());
    }
}
