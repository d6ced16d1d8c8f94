// Parameters, routine data, handlers and the frame of one routine.

#include "frontend/syntax/token_set.h"
#include "frontend/syntax/tree_walk.h"
#include "ir/lower/routine_lowering.h"

#include <algorithm>
#include <fmt/format.h>

namespace rapid::lower {

using sema::DataSymbol;
using sema::LanguageError;
using sema::RoutineSymbol;

ir::Routine declareRoutine(ProgramLowering& program, const RoutineSymbol& symbol, uint32_t task) {
    ir::Routine routine;
    routine.displayName = symbol.name;
    routine.moduleName = symbol.module->name;
    routine.name = fmt::format("{}/{}/{}", program.task(task).name, symbol.module->name, symbol.name);
    routine.noStepIn = symbol.noStepIn;
    routine.isBuiltin = symbol.predefined;
    routine.stepping = program.stepping();
    if (routine.stepping) routine.textHash = textHash(symbol);
    routine.callable = symbol.routineKind == syntax::RoutineKind::Proc && symbol.params.empty();
    routine.hasBackward = program.stepping() && symbol.routineDecl && symbol.routineDecl->hasBackward;
    const auto& tree = *symbol.module->tree;
    routine.file = program.fileIndex(tree.source->path());
    routine.line = tree.source->lineColumn(tree.range(symbol.nameToken).begin).line;
    if (symbol.routineKind == syntax::RoutineKind::Func) routine.result = program.irType(symbol.returnType);
    for (const DataSymbol* param : symbol.params) {
        int dimension = 0;
        rt::forEachSlot(shapeOf(*param), [&](rt::Slot slot) {
            const bool isDimension = slot == rt::Slot::Dimension;
            routine.params.push_back(
                {isDimension ? fmt::format("{}$dim{}", param->name, ++dimension) : param->name,
                 program.slotType(slot, *param)});
        });
        if (program.passesName(*param)) routine.params.push_back({param->name + "$name", ir::kPtr});
    }
    return routine;
}

/// A native called in it finds the data of the routine by name: they lie in memory and are described then.
bool RoutineLowering::reachesRoutineData(const syntax::Node& node) const {
    const auto found = facts().calls.find(&node);
    if (found != facts().calls.end() && found->second.routine &&
        found->second.routine->traits.has(sema::Trait::RoutineData))
        return true;
    bool reaches = false;
    syntax::forEachChild(node,
                         [&](const syntax::Node& child) { reaches = reaches || reachesRoutineData(child); });
    return reaches;
}

RoutineLowering::RoutineLowering(ProgramLowering& program, const RoutineSymbol& symbol, uint32_t task,
                                 const ir::Routine& declared)
    : program_(program), symbol_(symbol), module_(symbol.module), task_(task), routine_(declared),
      b_(program.module(), routine_) {
    hasErrorHandler_ = !symbol.routineDecl->errors.empty();
    const auto& tree = *symbol.module->tree;
    for (syntax::TokenIndex t = symbol.routineDecl->first; t <= symbol.routineDecl->last; ++t)
        routineHasPlaceholders_ = routineHasPlaceholders_ || syntax::isPlaceholder(tree.tokens[t].kind);
    reachesData_ = program.reachesRoutineData() && reachesRoutineData(*symbol.routineDecl);
    describesData_ = reachesData_ || program.stepping();
}

void RoutineLowering::lowerParameters() {
    uint32_t number = 0;
    for (const DataSymbol* param : symbol_.params) {
        Slot slot;
        slot.param = number;
        const Passing passing = passingOf(*param);
        const ir::TypeId type = program_.irType(param->type.type);
        number += rt::slotCount(shapeOf(*param));
        if (program_.passesName(*param)) slot.name = number++;
        if (passing == Passing::Switch) {
            if (describesData_) describeSwitch(*param, slot);
            slots_[param] = slot;
            continue;
        }
        if (passing == Passing::Value) {
            slot.local = b_.addLocal(param->name, type, true);
            describeLocal(slot.local, param->type);
            b_.store(type, b_.param(slot.param), b_.localAddr(slot.local));
            slots_[param] = slot;
            continue;
        }
        slot.kind = Slot::Kind::Pointer;
        slot.optional = param->optional;
        // IN is a private value: it is copied when the routine changes it, or when something else might.
        const bool copied = param->mode == syntax::ParamMode::In &&
                            (param->assigned || reachesData_ || program_.copies(*param));
        if (copied && param->type.isArray()) {
            copyArrayParameter(*param, slot);
        } else if (copied && type != ir::kI64) {
            slot.kind = Slot::Kind::Local;
            slot.local = b_.addLocal(param->name, type, true);
            if (param->optional) {
                const ir::BlockId given = b_.addBlock("given");
                const ir::BlockId after = b_.addBlock("after");
                b_.condBr(b_.binary(ir::Op::INe, b_.param(slot.param), b_.nullPtr()), given, after);
                b_.setBlock(given);
                b_.copy(type, b_.localAddr(slot.local), b_.param(slot.param));
                b_.br(after);
                b_.setBlock(after);
            } else {
                b_.copy(type, b_.localAddr(slot.local), b_.param(slot.param));
            }
        }
        if (describesData_ && passing == Passing::Pointer) {
            if (slot.kind == Slot::Kind::Local && param->optional)
                describeOptional(*param, slot);
            else if (slot.kind == Slot::Kind::Local)
                describeLocal(slot.local, param->type);
            else
                describeReference(*param, slot);
        }
        slots_[param] = slot;
    }
}

void RoutineLowering::describeLocal(uint32_t local, const sema::DataType& type) {
    if (describesData_) routine_.locals[local].typeDesc = program_.typeDesc(type);
}

void RoutineLowering::describeSwitch(const DataSymbol& param, const Slot& slot) {
    const uint32_t shown = b_.addLocal(param.name, ir::kBool, true);
    b_.store(ir::kBool, parameter(slot.param), b_.localAddr(shown));
    describeLocal(shown, scalarType(program_.program().boolean));
}

/// The private copy of an optional parameter: shown only when the parameter is present.
void RoutineLowering::describeOptional(const DataSymbol& param, const Slot& slot) {
    const uint32_t shown = b_.addLocal(param.name, ir::kPtr, true);
    b_.store(ir::kPtr, addressIfPresent(slot), b_.localAddr(shown));
    routine_.locals[shown].reference = true;
    routine_.locals[shown].typeDesc = program_.typeDesc(param.type);
}

/// The debugger finds the object by a local that holds its address, and arrays by locals with their dimensions.
void RoutineLowering::describeReference(const DataSymbol& param, const Slot& slot) {
    uint32_t shown = slot.local;
    if (shown == ir::kNone) {
        shown = b_.addLocal(param.name, ir::kPtr, true);
        b_.store(ir::kPtr, parameter(slot.param), b_.localAddr(shown));
    }
    routine_.locals[shown].reference = true;
    routine_.locals[shown].typeDesc = program_.typeDesc(scalarType(param.type.type));
    if (!param.type.isArray()) return;
    routine_.locals[shown].rank = param.type.rank;
    for (uint32_t k = 0; k < param.type.rank; ++k) {
        const uint32_t dim = b_.addLocal("", ir::kI32, true);
        if (k == 0) routine_.locals[shown].dims = dim;
        b_.store(ir::kI32, parameter(slot.param + 1 + k), b_.localAddr(dim));
    }
}

/// IN is a private value: an array that the routine changes is copied, its size is known at run time only.
void RoutineLowering::copyArrayParameter(const DataSymbol& param, Slot& slot) {
    startStatement(*param.decl, ir::StmtKind::Plain);
    ValueId count = b_.param(slot.param + 1);
    for (uint32_t k = 1; k < param.type.rank; ++k)
        count = b_.binary(ir::Op::IMul, count, b_.param(slot.param + 1 + k));
    const ir::TypeId element = program_.irType(param.type.type);
    const ValueId bytes = b_.binary(ir::Op::IMul, b_.convert(ir::Op::SExt, ir::kI64, count),
                                    b_.constI64(program_.module().size(element)));
    const ValueId copy = b_.stackAlloc(bytes);
    b_.copyDynamic(copy, b_.param(slot.param), bytes);
    slot.local = b_.addLocal(param.name, ir::kPtr, true);
    b_.store(ir::kPtr, copy, b_.localAddr(slot.local));
}

void RoutineLowering::lowerData() {
    for (const DataSymbol* data : symbol_.data) {
        if (data->storage != sema::Storage::RoutineData) continue;
        if (data->dataKind == syntax::DataKind::Const) continue; // folded, or a constant global on first use
        if (isWithoutForm(*data)) continue;                      // whoever uses it raises an error
        const ir::TypeId type = program_.irType(data->type);
        Slot slot;
        slot.local = b_.addLocal(data->name, type);
        describeLocal(slot.local, data->type);
        slots_[data] = slot;
    }
    for (const DataSymbol* data : symbol_.data) {
        auto found = slots_.find(data);
        if (found == slots_.end() || data->storage != sema::Storage::RoutineData) continue;
        const ValueId target = b_.localAddr(found->second.local);
        if (data->init) {
            // A constant value leaves out what belongs to components of unknown types.
            const bool plain = data->init->kind == syntax::NodeKind::Aggregate &&
                               syntax::as<syntax::AggregateExpr>(*data->init).isPlain();
            if (!plain && !info(*data->init).constant &&
                lowerUnresolved(*data->decl, *data->init, ir::StmtKind::Plain))
                continue;
            startStatement(*data->decl, ir::StmtKind::Plain);
            lowerInto(*data->init, data->type, target);
        } else {
            b_.zero(program_.irType(data->type), target);
        }
    }
}

/// The buffers are made where they are needed first.
void RoutineLowering::clearArrayBuffers(ir::BlockId entry) {
    if (arrayBuffers_.empty()) return;
    std::vector<ir::ValueId>& first = routine_.blocks[entry].insts;
    const std::vector<ir::ValueId> rest = std::exchange(first, {});
    b_.setBlock(entry);
    for (const uint32_t buffer : arrayBuffers_)
        b_.store(ir::kPtr, b_.nullPtr(), b_.localAddr(buffer));
    first.insert(first.end(), rest.begin(), rest.end());
}

ir::Routine RoutineLowering::run() {
    const ir::BlockId entry = b_.addBlock("entry");
    b_.setBlock(entry);
    CostScope costs;
    openCosts(costs);
    if (hasErrorHandler_) routine_.errorHandler = b_.addBlock("error");
    lowerParameters();
    lowerData();
    if (needsDetachedHandler()) shareData();
    if (routine_.hasBackward) lowerBackwardHandler();
    inInstructions_ = true;
    lowerList(symbol_.routineDecl->body);
    closeCosts(); // the end below is not part of every profile
    if (!b_.terminated()) {
        inInstructions_ = false; // the end is not an instruction that RETRY or TRYNEXT could name
        if (symbol_.routineKind == syntax::RoutineKind::Func) {
            startStatement(*symbol_.routineDecl, ir::StmtKind::Return);
            b_.raise(b_.constI32(program_.errorNumber(LanguageError::FunctionEnd)));
        } else {
            b_.ret();
        }
    }
    chargeAtFront(entry, costs.cost());
    lowerHandlers();
    clearArrayBuffers(0);
    return std::move(routine_);
}

void RoutineLowering::lowerHandlers() {
    if (hasErrorHandler_) lowerErrorHandler();
    if (symbol_.routineDecl->hasUndo) {
        region_ = Region::Undo;
        routine_.undoHandler = b_.addBlock("undo");
        b_.setBlock(routine_.undoHandler);
        CostScope costs;
        openCosts(costs);
        lowerList(symbol_.routineDecl->undo);
        if (!b_.terminated()) b_.ret();
        closeCosts();
        chargeAtFront(routine_.undoHandler, costs.cost());
    }
}

/// A call that is executed backwards runs this part instead of the body (manual 1.21).
void RoutineLowering::lowerBackwardHandler() {
    const ir::BlockId backward = b_.addBlock("backward");
    const ir::BlockId body = b_.addBlock("body");
    CostScope costs;
    openCosts(costs); // not part of the body: the release profile has no such part
    startStatement(*symbol_.routineDecl, ir::StmtKind::Handler);
    costs.statements = 0;
    const ValueId asked = b_.callNative(program_.support(Support::rt_takeBackward), {});
    b_.condBr(asked, backward, body);
    b_.setBlock(backward);
    region_ = Region::Backward;
    lowerList(symbol_.routineDecl->backward);
    if (!b_.terminated()) b_.ret();
    closeCosts();
    chargeAtFront(backward, costs.cost());
    region_ = Region::Body;
    b_.setBlock(body);
}

void RoutineLowering::lowerErrorHandler() {
    region_ = Region::Error;
    b_.setBlock(routine_.errorHandler);
    if (needsDetachedHandler()) lowerTakeDecision();
    const ir::BlockId begin = b_.block(); // what was decided is taken before a trap routine can run
    CostScope costs;
    openCosts(costs);
    lowerErrorClauses();
    closeCosts();
    // An empty handler has no statement at which a safepoint could find the task, and its end is an event of its own.
    if (costs.statements > 0) chargeAtFront(begin, costs.cost());
}

void RoutineLowering::lowerErrorClauses() {
    bool lists = false, others = false, all = false;
    for (const syntax::ErrorClause* clause : symbol_.routineDecl->errors) {
        const ir::BlockId next = b_.addBlock("clause");
        if (clause->hasList) {
            lists = true;
            const ir::BlockId body = b_.addBlock("handler");
            for (const Expr* number : clause->numbers)
                others = lowerListedNumber(*number, body) || others;
            b_.br(next);
            b_.setBlock(body);
        } else {
            others = all = true;
        }
        lowerList(clause->body);
        if (!b_.terminated()) b_.handlerEnd();
        b_.setBlock(next);
    }
    if (!all && !b_.terminated()) { // variables of the routine are known here only: no clause lists the error
        if (routine_.statements.empty()) startStatement(*symbol_.routineDecl, ir::StmtKind::Handler);
        b_.callNative(program_.support(Support::rt_errorNotListed), {});
    }
    if (!b_.terminated()) b_.unreachable();
    if (lists && others)
        routine_.errorFilter.push_back(ir::kOwnErrors); // takes the others, too, from its own calls
}

namespace {
constexpr int32_t kNoError = -1;
} // namespace

/// One number in the list of an ERROR clause: goes to `body` when it is the error. True when it is known only here (a
/// variable of the routine), so that the handler must be asked for every error.
bool RoutineLowering::lowerListedNumber(const Expr& number, ir::BlockId body) {
    if (LanguageError ignored = LanguageError::None; !missingReference(number, ignored).empty()) {
        routine_.errorFilter.push_back(kNoError); // an error that nothing here can raise
        return false;
    }
    startStatement(number, ir::StmtKind::Control);
    const sema::ConstValue* value = info(number).constant;
    const ir::BlockId other = b_.addBlock("other");
    bool unknown = false;
    if (value != nullptr) {
        const auto numeric = static_cast<int32_t>(value->number);
        const bool all = numeric == program_.allErrors();
        routine_.errorFilter.push_back(all ? ir::kEveryError : numeric);
        if (all)
            b_.condBr(b_.constBool(true), body, other);
        else
            b_.condBr(b_.binary(ir::Op::IEq, b_.sysvar(ir::SysvarKind::Error), b_.constI32(numeric)), body,
                      other);
    } else {
        const ValueId wanted = lowerValueAs(number, program_.program().num);
        const auto* symbol = rootSymbol(number);
        const bool ofModule = symbol && unparen(number).kind == syntax::NodeKind::Name &&
                              (symbol->storage == sema::Storage::ModuleData);
        if (ofModule)
            routine_.errorFilterGlobals.push_back(program_.globalFor(*symbol, task_));
        else
            unknown = true;
        const ValueId raised = b_.convert(ir::Op::SIntToFloat, ir::kF32, b_.sysvar(ir::SysvarKind::Error));
        b_.condBr(b_.binary(ir::Op::FEq, raised, wanted), body, other);
    }
    b_.setBlock(other);
    return unknown;
}

const RoutineLowering::Slot* RoutineLowering::findSlot(const DataSymbol& symbol) const {
    auto found = slots_.find(&symbol);
    return found == slots_.end() ? nullptr : &found->second;
}

const RoutineLowering::Expr& RoutineLowering::unparen(const Expr& expr) {
    const Expr* e = &expr;
    while (e->kind == syntax::NodeKind::Paren)
        e = syntax::as<syntax::ParenExpr>(*e).inner;
    return *e;
}

uint32_t RoutineLowering::temp(ir::TypeId type) {
    uint32_t local = 0;
    if (auto found = freeTemps_.find(type); found != freeTemps_.end()) {
        local = found->second;
        freeTemps_.erase(found);
    } else {
        local = b_.addLocal("", type);
    }
    usedTemps_.emplace_back(type, local);
    return local;
}

} // namespace rapid::lower
