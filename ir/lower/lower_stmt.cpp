// Statements except FOR.

#include "frontend/syntax/tree_walk.h"
#include "ir/lower/routine_lowering.h"

#include <fmt/format.h>

namespace rapid::lower {

using namespace syntax;

void RoutineLowering::startStatement(const Node& node, ir::StmtKind kind) {
    const auto& tree = *module_->tree;
    const SourceRange range = tree.range(node);
    const LineColumn from = tree.source->lineColumn(range.begin);
    const LineColumn to = tree.source->lineColumn(range.end);
    ir::Statement row;
    row.line = from.line;
    row.column = from.column;
    row.endLine = to.line;
    row.endColumn = to.column;
    row.kind = region_ == Region::Body ? kind : ir::StmtKind::Handler;
    row.handled = region_ == Region::Body && hasErrorHandler_ && inInstructions_;
    b_.setStatement(b_.addStatement(row));
    if (costs_ != nullptr) ++costs_->statements;
    if (node.kind != NodeKind::Routine) checkData(node);
}

void RoutineLowering::lowerList(StmtList list) {
    ir::StmtId previous = ir::kNone;
    for (const Stmt* stmt : list) {
        const size_t mark = usedTemps_.size();
        // RETRY enters at the beginning of a statement, TRYNEXT after it: both must be block borders.
        const bool resumable =
            ((hasRetry() && region_ == Region::Body) || program_.stepping()) && stmt->kind != NodeKind::Label;
        if (resumable) {
            const ir::BlockId start = b_.addBlock("stmt");
            const ir::BlockId next = b_.addBlock("next");
            const size_t firstRow = routine_.statements.size();
            branchIfOpen(start);
            b_.setBlock(start);
            lowerStmt(*stmt);
            branchIfOpen(next);
            // Rows made by this statement itself, not by nested ones, which have set their own.
            size_t own = 0;
            for (size_t i = firstRow; i < routine_.statements.size(); ++i) {
                ir::Statement& row = routine_.statements[i];
                if (row.start != ir::kNone) continue;
                if (program_.stepping()) row.flags |= resumeFlags(*stmt, own++);
                row.start = start;
                row.next = next;
                row.previous = previous;
            }
            if (program_.stepping() && firstRow < routine_.statements.size()) {
                routine_.statements[firstRow].flags |= statementFlags(*stmt);
                previous = static_cast<ir::StmtId>(firstRow);
            }
            b_.setBlock(next);
        } else {
            lowerStmt(*stmt);
        }
        for (size_t i = mark; i < usedTemps_.size(); ++i)
            freeTemps_.emplace(usedTemps_[i]);
        usedTemps_.resize(mark);
    }
}

/// The effect of the instruction executed backwards (manual 1.21).
uint8_t RoutineLowering::statementFlags(const Stmt& stmt) const {
    uint8_t flags = 0;
    if (region_ == Region::Backward) flags |= ir::kStmtInBackward;
    if (region_ == Region::Error || region_ == Region::Undo) flags |= ir::kStmtInHandler;
    if (stmt.kind != NodeKind::CallStmt) return flags;
    // Whether a procedure that is found by name says how it is executed backwards shows when it is called.
    constexpr uint8_t kLate = ir::kStmtCallsRoutine | ir::kStmtCallsBackward;
    if (as<CallStmt>(stmt).lateName) return flags | kLate;
    const auto found = facts().calls.find(&stmt);
    if (found == facts().calls.end()) return flags;
    if (!found->second.routine) return flags | kLate;
    const sema::RoutineSymbol& callee = *found->second.routine;
    if (!callee.predefined) {
        flags |= ir::kStmtCallsRoutine;
        if (callee.routineDecl && callee.routineDecl->hasBackward) flags |= ir::kStmtCallsBackward;
    }
    if (callee.effects == sema::Effects::Motion) flags |= ir::kStmtMovement;
    if (callee.traits.has(sema::Trait::ForwardOnly)) flags |= ir::kStmtForwardOnly;
    return flags;
}

/// Instructions that cannot begin without the part that a placeholder marks.
bool RoutineLowering::lowerIncomplete(const Stmt& stmt) {
    bool incomplete = false;
    switch (stmt.kind) {
    case NodeKind::PlaceholderStmt: incomplete = true; break;
    case NodeKind::Connect:
    case NodeKind::Goto: incomplete = containsPlaceholder(stmt); break;
    case NodeKind::CallStmt: incomplete = isIncompleteCall(stmt); break;
    case NodeKind::For: {
        const auto& loop = as<ForStmt>(stmt);
        const bool named = facts().loopVariables.find(&loop) != facts().loopVariables.end();
        incomplete = (!named && routineHasPlaceholders_) || isIncomplete(*loop.from) ||
                     isIncomplete(*loop.to) || (loop.step && isIncomplete(*loop.step));
        break;
    }
    case NodeKind::Test: {
        const auto& test = as<TestStmt>(stmt);
        incomplete = isIncomplete(*test.subject);
        break;
    }
    default: break;
    }
    if (!incomplete) return false;
    startStatement(stmt, ir::StmtKind::Plain);
    reachPlaceholder(stmt);
    return true;
}

void RoutineLowering::lowerStmt(const Stmt& stmt) {
    if (lowerIncomplete(stmt)) return;
    if (lowerUnresolved(stmt, stmt, ir::StmtKind::Plain)) return;
    switch (stmt.kind) {
    case NodeKind::Assign:
        lowerAssign(as<AssignStmt>(stmt));
        return noteAssigned(*as<AssignStmt>(stmt).target);
    case NodeKind::CallStmt: {
        const auto& call = as<CallStmt>(stmt);
        const auto found = facts().calls.find(&stmt);
        const bool motion = found != facts().calls.end() && found->second.routine &&
                            found->second.routine->effects == sema::Effects::Motion;
        startStatement(stmt, motion ? ir::StmtKind::Motion : ir::StmtKind::Call);
        if (call.lateName || (found != facts().calls.end() && !found->second.routine))
            return lowerLateCall(call);
        lowerCall(stmt, ir::kNone);
        if (region_ == Region::Error && isStartMoveRetry(stmt)) lowerRetry();
        return;
    }
    case NodeKind::If: return lowerIf(as<IfStmt>(stmt));
    case NodeKind::CompactIf: return lowerCompactIf(as<CompactIfStmt>(stmt));
    case NodeKind::For: return lowerFor(as<ForStmt>(stmt));
    case NodeKind::While: return lowerWhile(as<WhileStmt>(stmt));
    case NodeKind::Test: return lowerTest(as<TestStmt>(stmt));
    case NodeKind::Return: return lowerReturn(as<ReturnStmt>(stmt));
    case NodeKind::Raise: return lowerRaise(as<RaiseStmt>(stmt));
    case NodeKind::Connect: return lowerConnect(as<ConnectStmt>(stmt));
    case NodeKind::Exit: startStatement(stmt, ir::StmtKind::Control); return lowerExit();
    case NodeKind::Retry: startStatement(stmt, ir::StmtKind::Control); return lowerRetry();
    case NodeKind::TryNext: startStatement(stmt, ir::StmtKind::Control); return lowerTryNext();
    case NodeKind::Break:
    case NodeKind::Continue:
        if (facts().calls.find(&stmt) != facts().calls.end()) { // a procedure of that name in old files
            startStatement(stmt, ir::StmtKind::Call);
            lowerCall(stmt, ir::kNone);
            return;
        }
        startStatement(stmt, ir::StmtKind::Control);
        if (loops_.empty()) return;
        b_.br(stmt.kind == NodeKind::Break ? loops_.back().onBreak : loops_.back().onContinue);
        return;
    case NodeKind::Goto: {
        startStatement(stmt, ir::StmtKind::Control);
        const auto& refs = facts().references;
        const auto found = refs.find(&stmt);
        if (found == refs.end()) return;
        chargeJump(found->second->decl);
        b_.br(labelBlock(found->second->decl));
        return;
    }
    case NodeKind::Label: {
        const ir::BlockId block = labelBlock(&stmt);
        branchIfOpen(block);
        b_.setBlock(block);
        if (costs_ != nullptr) labelCosts_[&stmt] = {costs_->id, costs_->statements};
        return;
    }
    default: return; // empty instructions; errors do not get here
    }
}

/// The instruction replaces two: StartMove and RETRY (manual 1.12).
bool RoutineLowering::isStartMoveRetry(const Stmt& stmt) const {
    const auto found = facts().calls.find(&stmt);
    const sema::RoutineSymbol* routine = found == facts().calls.end() ? nullptr : found->second.routine;
    return routine != nullptr && routine->role == sema::Role::StartMoveRetry;
}

void RoutineLowering::lowerAssign(const AssignStmt& stmt) {
    startStatement(stmt, ir::StmtKind::Plain);
    if (isIncomplete(*stmt.target) || isIncomplete(*stmt.value)) return reachPlaceholder(stmt);
    const Place target = place(*stmt.target);
    const ir::TypeId element = program_.irType(target.type.type);
    if (!target.type.isArray() && program_.module().isScalar(element) && element != ir::kI64) {
        b_.store(element, lowerValueAs(*stmt.value, target.type.type), target.addr);
        return;
    }
    const Expr& value = unparen(*stmt.value);
    if (target.type.isArray() && (value.kind == NodeKind::Name || !isOfKnownSize(value, target.type)))
        return assignArray(value, target, *stmt.target);
    if (!isJoin(value) && (mayAlias(value, *stmt.target) || mayFailHalfway(value))) {
        const ValueId buffer = tempAddr(program_.irType(target.type));
        lowerInto(value, target.type, buffer);
        b_.copy(program_.irType(target.type), target.addr, buffer);
    } else {
        lowerInto(value, target.type, target.addr);
    }
}

void RoutineLowering::lowerIf(const IfStmt& stmt) {
    const ir::BlockId end = b_.addBlock("endif");
    for (const IfBranch* branch : stmt.branches) {
        if (!branch->condition) { // <EIT>
            startStatement(*branch, ir::StmtKind::Control);
            reachPlaceholder(*branch);
            continue;
        }
        const ir::BlockId body = b_.addBlock("then");
        const ir::BlockId next = b_.addBlock("else");
        if (lowerOpenHead(*branch->condition)) {
            b_.condBr(b_.constBool(false), body, next);
        } else {
            startStatement(*branch->condition, ir::StmtKind::Control);
            lowerCond(*branch->condition, body, next);
        }
        b_.setBlock(body);
        lowerList(branch->body);
        branchIfOpen(end);
        b_.setBlock(next);
    }
    lowerList(stmt.elseBody);
    branchIfOpen(end);
    b_.setBlock(end);
}

void RoutineLowering::lowerCompactIf(const CompactIfStmt& stmt) {
    if (lowerOpenHead(*stmt.condition)) return;
    const ir::BlockId body = b_.addBlock("then");
    const ir::BlockId end = b_.addBlock("endif");
    startStatement(*stmt.condition, ir::StmtKind::Control);
    lowerCond(*stmt.condition, body, end);
    b_.setBlock(body);
    Stmt* inner = stmt.body;
    lowerList({&inner, 1});
    branchIfOpen(end);
    b_.setBlock(end);
}

void RoutineLowering::lowerWhile(const WhileStmt& stmt) {
    if (lowerOpenHead(*stmt.condition)) return;
    const ir::BlockId head = b_.addBlock("while");
    const ir::BlockId body = b_.addBlock("do");
    const ir::BlockId latch = b_.addBlock("again");
    const ir::BlockId end = b_.addBlock("endwhile");
    b_.br(head);
    b_.setBlock(head);
    CostScope costs;
    openCosts(costs);
    startStatement(*stmt.condition, ir::StmtKind::Control);
    lowerCond(*stmt.condition, body, end);
    b_.setBlock(body);
    loops_.push_back({end, latch});
    lowerList(stmt.body);
    loops_.pop_back();
    closeCosts();
    branchIfOpen(latch);
    b_.setBlock(latch);
    b_.charge(costs.cost());
    b_.br(head);
    b_.setBlock(end);
}

void RoutineLowering::lowerTest(const TestStmt& stmt) {
    if (lowerOpenHead(*stmt.subject)) return;
    startStatement(*stmt.subject, ir::StmtKind::Control);
    checkData(stmt); // what the cases compare with, too
    const sema::DataType type = info(*stmt.subject).type();
    const ir::TypeId irType = program_.irType(type.type);
    const bool signal = namesSignal(*stmt.subject);
    const bool scalar = signal || (!type.isArray() && program_.module().isScalar(irType));
    const ir::TypeId valueType = signal ? ir::kF32 : irType;
    // The subject is evaluated once (manual 1.5).
    const ValueId subject = b_.localAddr(b_.addLocal("", valueType));
    if (scalar)
        b_.store(valueType, signal ? readSignal(*stmt.subject, false) : lowerValue(*stmt.subject), subject);
    else
        lowerInto(*stmt.subject, type, subject);
    const ir::BlockId end = b_.addBlock("endtest");
    for (const TestCase* testCase : stmt.cases) {
        if (testCase->values.empty()) { // <CSE>
            startStatement(*testCase, ir::StmtKind::Control);
            reachPlaceholder(*testCase);
            continue;
        }
        const ir::BlockId body = b_.addBlock("case");
        const ir::BlockId next = b_.addBlock("nextcase");
        for (const Expr* value : testCase->values) {
            if (lowerOpenHead(*value)) continue;
            const ir::BlockId other = b_.addBlock("othervalue");
            ValueId equal = ir::kNone;
            if (scalar) {
                const bool isBool = valueType == ir::kBool;
                const ValueId wanted =
                    signal ? lowerValueAs(*value, program_.program().num) : lowerValueAs(*value, type.type);
                equal = b_.binary(isBool ? ir::Op::IEq : ir::Op::FEq, b_.load(valueType, subject), wanted);
            } else {
                const ValueId wanted = tempAddr(irType);
                lowerInto(*value, type, wanted);
                equal = equalPlaces(subject, wanted, type);
            }
            b_.condBr(equal, body, other);
            b_.setBlock(other);
        }
        b_.br(next);
        b_.setBlock(body);
        lowerList(testCase->body);
        branchIfOpen(end);
        b_.setBlock(next);
    }
    lowerList(stmt.defaultBody);
    branchIfOpen(end);
    b_.setBlock(end);
}

void RoutineLowering::lowerReturn(const ReturnStmt& stmt) {
    startStatement(stmt, ir::StmtKind::Return);
    if (region_ == Region::Undo) return lowerIgnoredInUndo("RETURN");
    if (body_) return lowerDetachedReturn(stmt);
    if (!stmt.value || symbol_.routineKind != RoutineKind::Func) return b_.ret();
    const ir::TypeId type = program_.irType(symbol_.returnType);
    if (program_.module().isScalar(type)) return b_.ret(lowerValueAs(*stmt.value, symbol_.returnType.type));
    if (mayFailHalfway(*stmt.value)) {
        const ValueId buffer = tempAddr(type);
        lowerInto(*stmt.value, symbol_.returnType, buffer);
        b_.copy(type, b_.resultAddr(), buffer);
    } else {
        lowerInto(*stmt.value, symbol_.returnType, b_.resultAddr());
    }
    b_.ret();
}

void RoutineLowering::lowerRaise(const RaiseStmt& stmt) {
    startStatement(stmt, ir::StmtKind::Control);
    if (region_ == Region::Undo) return lowerIgnoredInUndo("RAISE");
    if (!stmt.value)
        return region_ == Region::Error ? b_.propagate() : b_.raise(b_.sysvar(ir::SysvarKind::Error));
    const ValueId given = lowerValueAs(*stmt.value, program_.program().num);
    ValueId number = ir::kNone;
    if (const sema::ConstValue* value = info(*stmt.value).constant)
        number = b_.constI32(static_cast<int32_t>(value->number)); // the checker knows that it may be raised
    else
        number = b_.callNative(program_.support(Support::rt_raiseNumber), {given});
    if (region_ == Region::Body) return b_.raise(number);
    b_.callNative(program_.support(Support::rt_raiseToCaller), {number});
    b_.unreachable();
}

/// Manual 1.13: a warning, and execution continues after the instruction.
void RoutineLowering::lowerIgnoredInUndo(const char* instruction) {
    b_.callNative(program_.support(Support::rt_ignoredInUndo),
                  {b_.globalAddr(program_.stringGlobal(instruction))});
}

void RoutineLowering::lowerConnect(const ConnectStmt& stmt) {
    startStatement(stmt, ir::StmtKind::Plain);
    const auto& refs = facts().references;
    auto found = refs.find(&stmt);
    if (found == refs.end() || found->second->kind != sema::SymbolKind::Routine) return;
    const auto& symbol = *static_cast<const sema::RoutineSymbol*>(found->second);
    ValueId address = ir::kNone;
    const Place target = place(*stmt.target);
    if (program_.isForeign(symbol) || program_.mayBeErased(symbol, module_)) {
        const ValueId name = b_.globalAddr(program_.stringGlobal(symbol.module->name + ":" + symbol.name));
        address = b_.callNative(program_.support(Support::rt_lateTrap), {name});
    } else {
        const uint32_t trap = program_.routineFor(symbol, task_);
        program_.module().routines[trap].exported = true;
        address = b_.routineAddr(trap);
    }
    b_.callNative(program_.support(Support::rt_connect), {target.addr, address});
}

void RoutineLowering::lowerExit() {
    b_.callNative(program_.support(Support::rt_exitProgram), {});
    b_.unreachable();
}

ir::BlockId RoutineLowering::labelBlock(const Node* label) {
    auto found = labels_.find(label);
    if (found != labels_.end()) return found->second;
    const ir::BlockId block = b_.addBlock("label");
    labels_[label] = block;
    return block;
}

} // namespace rapid::lower
