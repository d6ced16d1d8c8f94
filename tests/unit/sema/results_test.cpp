// The results of check() for lowering: types, constants, bound arguments, symbols and their places.

#include "sema_testing.h"

#include <catch2/catch.hpp>

#include <algorithm>

namespace {

using namespace rapid;
using namespace rapid::sema;
using namespace rapid::sema::testing;

const DataSymbol& data(const CheckedProgram& program, std::string_view name) {
    const Symbol* symbol = findSymbol(program, name);
    REQUIRE(symbol);
    REQUIRE(symbol->kind == SymbolKind::Data);
    return static_cast<const DataSymbol&>(*symbol);
}

const RoutineSymbol& routine(const CheckedProgram& program, std::string_view name) {
    const Symbol* symbol = findSymbol(program, name);
    REQUIRE(symbol);
    REQUIRE(symbol->kind == SymbolKind::Routine);
    return static_cast<const RoutineSymbol&>(*symbol);
}

const syntax::Stmt& bodyStmt(const RoutineSymbol& symbol, size_t index) {
    return *symbol.routineDecl->body[index];
}

std::vector<std::string> none() {
    return {};
}

} // namespace

TEST_CASE("initial values are folded and rounded to their type", "[sema]") {
    const auto c = checkTexts({"MODULE m\n"
                               "  CONST num tenth := 0.1;\n"
                               "  CONST dnum exact := 0.1;\n"
                               "  CONST num sum := 2 * third + 1;\n"
                               "  CONST num third := 1 / 3;\n"
                               "  CONST string text := \"a\" + \"\\41\\\\\";\n"
                               "  VAR pos place := [1, sum, -third];\n"
                               "  PERS num grid{2, 3} := [[1, 2, 3], [4, 5, 6]];\n"
                               "  VAR num plain;\n"
                               "  CONST num part := cells{2}.y;\n"
                               "  CONST pos cells{2} := [[1, 2, 3], [4, 5, 6]];\n"
                               "  CONST bool yes := tenth < third AND NOT FALSE;\n"
                               "  CONST num rest := -14 MOD 4;\n"
                               "ENDMODULE\n"});
    REQUIRE(c->messages() == none());
    const CheckedProgram& p = *c->program;
    const double third = static_cast<double>(1.0f / 3.0f);
    CHECK(data(p, "tenth").value().number == static_cast<double>(0.1f));
    CHECK(data(p, "exact").value().number == 0.1);
    CHECK(data(p, "third").value().number == third);
    CHECK(data(p, "sum").value().number == static_cast<double>(static_cast<float>(2 * third) + 1.0f));
    CHECK(data(p, "text").value().text() == "aA\\");
    const ConstValue& place = data(p, "place").value();
    REQUIRE(place.members().size() == 3);
    CHECK(place.members()[2].number == -third);
    const ConstValue& grid = data(p, "grid").value();
    REQUIRE(grid.members().size() == 2);
    REQUIRE(grid.members()[1].members().size() == 3);
    CHECK(grid.members()[1].members()[0].number == 4);
    CHECK(data(p, "plain").value().kind == ConstValue::Kind::None);
    CHECK(data(p, "part").value().number == 5);
    CHECK(data(p, "yes").value().boolean);
    CHECK(data(p, "rest").value().number == -2);
    CHECK(data(p, "grid").type.rank == 2);
    CHECK(data(p, "grid").type.dims[1] == 3);
    CHECK(data(p, "tenth").index == 0);
    CHECK(data(p, "exact").index == 1);
}

TEST_CASE("the value of literals is read when it is asked for", "[sema]") {
    const auto c = checkTexts(
        {"MODULE m\n"
         "  RECORD part\n"
         "    string text;\n"
         "    dnum exact;\n"
         "    bool good;\n"
         "    length size;\n"
         "  ENDRECORD\n"
         "  ALIAS num length;\n"
         "  PERS part parts{2} := [[\"a\\41\"\"\",0.1,TRUE,0.1],[\"\",-16777217,FALSE,-16777217]];\n"
         "  CONST pos seen := [1, -2.5, 3E2];\n"
         "  CONST num height := seen.z;\n"
         "ENDMODULE\n",
         "MODULE n\n"
         "  CONST num depth := seen.y;\n"
         "ENDMODULE\n"});
    REQUIRE(c->messages() == none());
    const CheckedProgram& p = *c->program;
    for (const bool again : {false, true}) {
        INFO(again);
        const ConstValue& parts = data(p, "parts").value();
        REQUIRE(parts.members().size() == 2);
        REQUIRE(parts.members()[0].members().size() == 4);
        const auto first = parts.members()[0].members(), second = parts.members()[1].members();
        CHECK(first[0].text() == "aA\"");
        CHECK(first[1].number == 0.1);
        CHECK(first[2].boolean);
        CHECK(first[3].number == static_cast<double>(0.1f));
        CHECK(second[0].kind == ConstValue::Kind::String);
        CHECK(second[0].text().empty());
        CHECK(second[1].number == -16777217);
        CHECK(second[2].kind == ConstValue::Kind::Bool);
        CHECK_FALSE(second[2].boolean);
        CHECK(second[3].number == -16777216);
        // Making the elements changes nothing.
        CHECK(syntax::as<syntax::AggregateExpr>(*data(p, "parts").init).elements().size() == 2);
    }
    CHECK(data(p, "height").value().number == 300);
    CHECK(data(p, "depth").value().number == -2.5);
}

TEST_CASE("literals of another shape or type than their data", "[sema]") {
    const auto c = checkTexts({"MODULE m\n"
                               "  CONST pos few := [1,2];\n"
                               "  CONST pos many := [1,2,3,4];\n"
                               "  CONST pos word := [1,\"a\",3];\n"
                               "  CONST pos nested := [1,[2],3];\n"
                               "  CONST num atom := [1];\n"
                               "  CONST num list{2} := [1,TRUE];\n"
                               "  CONST num rows{2,2} := [[1,2],3];\n"
                               "  CONST pose flat := [1,2];\n"
                               "ENDMODULE\n"});
    CHECK(c->codes() == std::vector<std::string>{"RAP3021", "RAP3021", "RAP3023", "RAP3022", "RAP3022",
                                                 "RAP3023", "RAP3023", "RAP3023", "RAP3023"});
    CHECK(data(*c->program, "word").value().kind == ConstValue::Kind::None);
}

TEST_CASE("literals take the numeric type of their context", "[sema]") {
    const auto c = checkTexts({"MODULE m\n"
                               "  VAR dnum d;\n"
                               "  VAR num n;\n"
                               "  PROC main()\n"
                               "    d := 0.1;\n"
                               "    n := 0.1;\n"
                               "    d := d + 2 * (3 - 1);\n"
                               "    IF 4294967297 = d n := 1;\n"
                               "  ENDPROC\n"
                               "ENDMODULE\n"});
    REQUIRE(c->messages() == none());
    const CheckedProgram& p = *c->program;
    const Module& m = *p.tasks[0]->modules[0];
    const RoutineSymbol& main = routine(p, "main");
    const auto& first = syntax::as<syntax::AssignStmt>(bodyStmt(main, 0));
    CHECK(p.info(m, *first.value).type().type == p.dnum);
    CHECK(p.info(m, *first.value).constant->number == 0.1);
    const auto& second = syntax::as<syntax::AssignStmt>(bodyStmt(main, 1));
    CHECK(p.info(m, *second.value).type().type == p.num);
    CHECK(p.info(m, *second.value).constant->number == static_cast<double>(0.1f));
    const auto& sum =
        syntax::as<syntax::BinaryExpr>(*syntax::as<syntax::AssignStmt>(bodyStmt(main, 2)).value);
    CHECK(p.info(m, sum).type().type == p.dnum);
    CHECK(p.info(m, *sum.right).type().type == p.dnum);
    REQUIRE(p.info(m, *sum.right).constant);
    CHECK(p.info(m, *sum.right).constant->number == 4);
    const auto& product = syntax::as<syntax::BinaryExpr>(*sum.right);
    CHECK(p.info(m, *product.left).type().type == p.dnum);
    CHECK(p.info(m, *product.right).type().type == p.dnum);
    const auto& test = syntax::as<syntax::CompactIfStmt>(bodyStmt(main, 3));
    const auto& equal = syntax::as<syntax::BinaryExpr>(*test.condition);
    CHECK(p.info(m, *equal.left).constant->number == 4294967297.0);
}

TEST_CASE("a call has one entry for each parameter, in order", "[sema]") {
    const auto c = checkTexts({"MODULE m\n"
                               "  PROC work(num a \\num b \\switch on | switch off, INOUT num d)\n"
                               "    d := a;\n"
                               "  ENDPROC\n"
                               "  PROC main(\\num given)\n"
                               "    VAR num v;\n"
                               "    work 1 \\b?given \\off, v;\n"
                               "  ENDPROC\n"
                               "ENDMODULE\n"});
    REQUIRE(c->messages() == none());
    const CheckedProgram& p = *c->program;
    const RoutineSymbol& work = routine(p, "work");
    const RoutineSymbol& main = routine(p, "main");
    REQUIRE(work.params.size() == 5);
    CHECK(work.params[2]->group == work.params[3]->group);
    CHECK(work.params[1]->group != work.params[2]->group);
    CHECK(work.params[4]->index == 4);
    CHECK(work.params[4]->assigned);
    CHECK_FALSE(work.params[0]->assigned);
    const auto call = p.tasks[0]->modules[0]->facts->calls.find(&bodyStmt(main, 0));
    REQUIRE(call != p.tasks[0]->modules[0]->facts->calls.end());
    CHECK(call->second.routine == &work);
    CHECK(call->second.module == p.tasks[0]->modules[0]);
    const std::span<BoundArg> args = call->second.args;
    REQUIRE(args.size() == 5);
    CHECK(args[0].kind == BoundArg::Kind::Present);
    CHECK(args[1].kind == BoundArg::Kind::Conditional);
    CHECK(args[2].kind == BoundArg::Kind::Absent);
    CHECK(args[3].kind == BoundArg::Kind::Present);
    CHECK(args[3].value == nullptr);
    CHECK(args[4].kind == BoundArg::Kind::Present);
    const Module& m = *p.tasks[0]->modules[0];
    CHECK(p.info(m, *args[4].value).symbol == main.data[0]);
    CHECK(main.data[0]->assigned);
    CHECK(main.data[0]->index == 1);
    CHECK(p.info(m, *args[1].value).symbol == main.params[0]);
    CHECK(p.tasks[0]->entryRoutine == &main);
}

TEST_CASE("one of several required parameters is chosen by type", "[sema]") {
    const auto c = checkTexts({"MODULE m\n"
                               "  VAR signalgo go1;\n"
                               "  VAR dnum d;\n"
                               "  PROC main()\n"
                               "    SetGO go1, 5;\n"
                               "    SetGO go1, d;\n"
                               "  ENDPROC\n"
                               "ENDMODULE\n"});
    REQUIRE(c->messages() == none());
    const CheckedProgram& p = *c->program;
    const RoutineSymbol& main = routine(p, "main");
    const auto chosen = [&](size_t stmt) {
        std::string names;
        for (const BoundArg& arg : p.tasks[0]->modules[0]->facts->calls.at(&bodyStmt(main, stmt)).args)
            if (arg.kind == BoundArg::Kind::Present) names += arg.param->name + " ";
        return names;
    };
    CHECK(chosen(0) == "Signal Value ");
    CHECK(chosen(1) == "Signal Dvalue ");
}

TEST_CASE("signals are values or handles by their place", "[sema]") {
    CheckOptions options;
    options.configurationKnown = true;
    options.signals = {{"gi1", "signalgi"}, {"DO_1", "signaldo"}};
    const auto c = checkTexts({"MODULE m\n"
                               "  VAR dnum d;\n"
                               "  PROC main()\n"
                               "    d := gi1;\n"
                               "    reg1 := gi1 + do_1;\n"
                               "    SetDO do_1, 1;\n"
                               "  ENDPROC\n"
                               "ENDMODULE\n"},
                              options);
    REQUIRE(c->messages() == none());
    const CheckedProgram& p = *c->program;
    const Module& m = *p.tasks[0]->modules[0];
    const RoutineSymbol& main = routine(p, "main");
    const syntax::Expr& first = *syntax::as<syntax::AssignStmt>(bodyStmt(main, 0)).value;
    CHECK(p.info(m, first).type().type == p.dnum);
    const auto& sum =
        syntax::as<syntax::BinaryExpr>(*syntax::as<syntax::AssignStmt>(bodyStmt(main, 1)).value);
    CHECK(p.info(m, *sum.left).type().type == p.num);
    CHECK(p.info(m, *sum.right).type().type == p.num);
    const BoundCall& call = p.tasks[0]->modules[0]->facts->calls.at(&bodyStmt(main, 2));
    CHECK(p.info(m, *call.args[2].value).type().type->kind == TypeKind::SemiValue);
    REQUIRE(p.tasks[0]->signals.size() == 2);
    CHECK(p.tasks[0]->signals[0]->storage == Storage::Signal);
    CHECK(p.tasks[0]->signals[1]->name == "DO_1");
}

TEST_CASE("loop variables, traps and labels are resolved", "[sema]") {
    const auto c = checkTexts({"MODULE m\n"
                               "  VAR intnum i1;\n"
                               "  PROC work(num a)\n"
                               "    VAR num b;\n"
                               "    FOR i FROM 1 TO 3 DO\n"
                               "      FOR i FROM i TO 5 DO\n"
                               "        b := i;\n"
                               "      ENDFOR\n"
                               "    ENDFOR\n"
                               "    CONNECT i1 WITH alarm;\n"
                               "    GOTO done;\n"
                               "  done:\n"
                               "  ENDPROC\n"
                               "  TRAP alarm\n"
                               "  ENDTRAP\n"
                               "ENDMODULE\n"});
    REQUIRE(c->messages() == none());
    const CheckedProgram& p = *c->program;
    const Task& task = *p.tasks[0];
    const Module& m = *task.modules[0];
    const RoutineSymbol& main = routine(p, "work");
    const auto& outer = syntax::as<syntax::ForStmt>(bodyStmt(main, 0));
    const auto& inner = syntax::as<syntax::ForStmt>(*outer.body[0]);
    DataSymbol* outerVariable = task.modules[0]->facts->loopVariables.at(&outer);
    DataSymbol* innerVariable = task.modules[0]->facts->loopVariables.at(&inner);
    CHECK(outerVariable != innerVariable);
    CHECK(p.info(m, *inner.from).symbol == outerVariable);
    CHECK(p.info(m, *syntax::as<syntax::AssignStmt>(*inner.body[0]).value).symbol == innerVariable);
    REQUIRE(main.data.size() == 3);
    CHECK(main.data[0]->index == 1);
    CHECK(main.data[1]->index == 2);
    CHECK(main.data[2]->index == 3);
    CHECK(task.modules[0]->facts->references.at(&bodyStmt(main, 1)) == &routine(p, "alarm"));
    const Symbol* label = task.modules[0]->facts->references.at(&bodyStmt(main, 2));
    CHECK(label->kind == SymbolKind::Label);
    CHECK(label->decl == &bodyStmt(main, 3));
}

TEST_CASE("aggregates have the type that their context gives", "[sema]") {
    const auto c = checkTexts({"MODULE m\n"
                               "  PROC take(num list{*})\n"
                               "  ENDPROC\n"
                               "  PROC main()\n"
                               "    VAR pos v;\n"
                               "    VAR num x;\n"
                               "    v := [x, 2, 3];\n"
                               "    take [1, 2, 3, 4];\n"
                               "    IF v = [1, 2, 3] x := 1;\n"
                               "  ENDPROC\n"
                               "ENDMODULE\n"});
    REQUIRE(c->messages() == none());
    const CheckedProgram& p = *c->program;
    const Module& m = *p.tasks[0]->modules[0];
    const RoutineSymbol& main = routine(p, "main");
    const ExprInfo& assigned = p.info(m, *syntax::as<syntax::AssignStmt>(bodyStmt(main, 0)).value);
    CHECK(assigned.type().type == p.typeOf(KnownType::Position));
    CHECK(assigned.constant == nullptr);
    const ExprInfo& list =
        p.info(m, *p.tasks[0]->modules[0]->facts->calls.at(&bodyStmt(main, 1)).args[0].value);
    CHECK(list.type().rank == 1);
    CHECK(list.type().dims[0] == 4);
    CHECK(list.type().type == p.num);
    REQUIRE(list.constant);
    CHECK(list.constant->members()[3].number == 4);
}

TEST_CASE("the library gives effects, traits and alternatives", "[sema]") {
    const auto c = checkTexts({"MODULE m\nENDMODULE\n"});
    const RoutineSymbol *moveL = nullptr, *present = nullptr, *setGo = nullptr, *waitUntil = nullptr;
    const DataSymbol* errorNumber = nullptr;
    for (const Module* module : c->program->predefinedModules) {
        CHECK(module->predefined);
        for (const RoutineSymbol* r : module->routines) {
            if (r->name == "MoveL") moveL = r;
            if (r->name == "Present") present = r;
            if (r->name == "SetGO") setGo = r;
            if (r->name == "WaitUntil") waitUntil = r;
        }
        for (const DataSymbol* d : module->data)
            if (d->name == "ERRNO") errorNumber = d;
    }
    REQUIRE(moveL);
    CHECK(moveL->effects == Effects::Motion);
    CHECK(moveL->native);
    CHECK(moveL->traits.has(Trait::Linear));
    REQUIRE(present);
    CHECK(present->role == Role::Present);
    CHECK(present->params[0]->mode == syntax::ParamMode::Ref);
    REQUIRE(setGo);
    CHECK(std::count_if(setGo->params.begin(), setGo->params.end(),
                        [](const DataSymbol* s) { return s->requiredAlternative; }) == 2);
    REQUIRE(waitUntil);
    CHECK(std::any_of(waitUntil->params.begin(), waitUntil->params.end(),
                      [](const DataSymbol* s) { return s->name == "Cond" && s->deferred; }));
    REQUIRE(errorNumber);
    CHECK(errorNumber->storage == Storage::SystemVariable);
}
