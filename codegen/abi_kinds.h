#pragma once
// Names of the same things in the IR and in the runtime. They may not include each other: here, in one place, each name of the IR
// gets its counterpart, and one that is added to the IR and has none does not compile (a switch without a default).

#include <llvm/Support/ErrorHandling.h>

#include "ir/core/ir.h"
#include "runtime/abi/rt_abi.h"

namespace codegen::abi {

constexpr rt::DescKind kindOf(ir::DescKind kind) {
    switch (kind) {
    case ir::DescKind::Float: return rt::DescKind::Num;
    case ir::DescKind::Double: return rt::DescKind::Dnum;
    case ir::DescKind::Bool: return rt::DescKind::Bool;
    case ir::DescKind::String: return rt::DescKind::String;
    case ir::DescKind::Record: return rt::DescKind::Record;
    case ir::DescKind::Array: return rt::DescKind::Array;
    case ir::DescKind::Handle: return rt::DescKind::Handle;
    case ir::DescKind::Other: return rt::DescKind::Other;
    case ir::DescKind::Bytes: return rt::DescKind::Bytes;
    }
    llvm_unreachable("kind of a type");
}

constexpr rt::StmtKind kindOf(ir::StmtKind kind) {
    switch (kind) {
    case ir::StmtKind::Plain: return rt::kStmtPlain;
    case ir::StmtKind::Call: return rt::kStmtCall;
    case ir::StmtKind::Motion: return rt::kStmtMotion;
    case ir::StmtKind::Control: return rt::kStmtControl;
    case ir::StmtKind::Return: return rt::kStmtReturn;
    case ir::StmtKind::Handler: return rt::kStmtHandler;
    }
    llvm_unreachable("kind of a statement");
}

constexpr rt::GlobalKind kindOf(ir::GlobalKind kind) {
    switch (kind) {
    case ir::GlobalKind::Var: return rt::kGlobalVariable;
    case ir::GlobalKind::Const: return rt::kGlobalConstant;
    case ir::GlobalKind::Persistent:
    case ir::GlobalKind::External: // a unit has rows for persistents that lie in another one
        return rt::kGlobalPersistent;
    }
    llvm_unreachable("kind of data");
}

constexpr rt::RoutineKind kindOf(ir::RoutineKind kind) {
    switch (kind) {
    case ir::RoutineKind::Procedure: return rt::kRoutineProc;
    case ir::RoutineKind::Function: return rt::kRoutineFunc;
    case ir::RoutineKind::Interrupt: return rt::kRoutineTrap;
    }
    llvm_unreachable("kind of a routine");
}

constexpr rt::ParamMode modeOf(ir::ParamMode mode) {
    switch (mode) {
    case ir::ParamMode::In: return rt::kParamIn;
    case ir::ParamMode::Variable: return rt::kParamVar;
    case ir::ParamMode::Persistent: return rt::kParamPers;
    case ir::ParamMode::Either: return rt::kParamInOut;
    }
    llvm_unreachable("mode of a parameter");
}

constexpr rt::StmtFlag flagOf(ir::StatementFlag flag) {
    switch (flag) {
    case ir::kStmtCallsRoutine: return rt::kStmtCallsRoutine;
    case ir::kStmtCallsBackward: return rt::kStmtCallsBackward;
    case ir::kStmtForwardOnly: return rt::kStmtForwardOnly;
    case ir::kStmtInBackward: return rt::kStmtInBackward;
    case ir::kStmtMovement: return rt::kStmtMovement;
    case ir::kStmtInHandler: return rt::kStmtInHandler;
    case ir::kStmtRepeatable: return rt::kStmtRepeatable;
    case ir::kStmtReenterable: return rt::kStmtReenterable;
    }
    return {};
}

constexpr rt::DataFlag flagOf(ir::DataFlag flag) {
    switch (flag) {
    case ir::kDataLocal: return rt::kDataLocal;
    case ir::kDataPredefined: return rt::kDataPredefined;
    }
    return {};
}

static_assert(ir::kEveryError == rt::kAllErrors && ir::kOwnErrors == rt::kOtherErrors,
              "error lists are passed on as they are");

/// Sets of flags are passed on as they are: every flag must be the same bit on both sides.
template <class Flag>
constexpr bool kSameBits = [] {
    for (int bit = 1; bit <= 0x80; bit <<= 1) {
        const auto flag = static_cast<Flag>(bit);
        if (flagOf(flag) != 0 && int{flagOf(flag)} != bit) return false;
    }
    return true;
}();
static_assert(kSameBits<ir::StatementFlag> && kSameBits<ir::DataFlag>);

} // namespace codegen::abi
