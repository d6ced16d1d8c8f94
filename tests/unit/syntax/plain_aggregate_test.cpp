// Aggregates of literals whose elements are made when they are asked for: nobody can tell them from others.

#include "syntax_test.h"

#include "frontend/syntax/tree_walk.h"

#include <catch2/catch.hpp>

#include <set>

using namespace rapid;
using test::inProcedure;
using test::parseText;
using namespace rapid::syntax;

namespace {

test::Parsed parseModuleData(const std::string& value) {
    return parseText("MODULE m\nCONST robtarget p:=" + value + ";\nCONST num after:=1;\nENDMODULE\n");
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
    const test::Parsed parsed = parseModuleData(kPlain[2]);
    const uint32_t count = parsed.tree->exprCount;
    std::multiset<uint32_t> ids;
    collectIds(*parsed.tree->modules[0], ids);
    CHECK(parsed.tree->exprCount == count);
    CHECK(ids.size() == count);
    for (uint32_t id = 0; id < count; ++id)
        CHECK(ids.count(id) == 1);
}

TEST_CASE("what is more than literals is no plain aggregate", "[syntax][tree]") {
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
