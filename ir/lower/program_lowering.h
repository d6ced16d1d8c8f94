#pragma once
// State shared by all routines of one program while it is lowered: types, globals, natives, routine numbers.

#include "ir/lower/argument_copies.h"
#include "ir/lower/evaluated_calls.h"
#include "ir/lower/lower.h"
#include "runtime/abi/support_natives.h"

#include <map>
#include <optional>
#include <unordered_map>
#include <unordered_set>

namespace rapid::lower {

using rt::Passing;
using Support = rt::support::Native;

/// The properties of a parameter for the calling convention (runtime/abi/native_signature.h).
rt::ParamShape shapeOf(const sema::DataSymbol& param);
inline Passing passingOf(const sema::DataSymbol& param) {
    return rt::passingOf(shapeOf(param));
}

ir::TypeId irTypeOf(ir::Module& module, rt::AbiType type);
template <class T> ir::TypeId irTypeOf(ir::Module& module) {
    return irTypeOf(module, rt::abiTypeOf<T>());
}

/// Of a type that a module declares which is not here: the instruction that uses such data raises an error.
bool isUnknown(const sema::DataType& type);
/// Module data or data of a routine of such a type, or of a size that is a placeholder: nothing is made for them.
bool isWithoutForm(const sema::DataSymbol& data);

class RoutineLowering;

// Size: all parts add to the tables of one IR module and share their indexes.
class ProgramLowering {
  public:
    ProgramLowering(const sema::CheckedProgram& program, const Options& options, diag::Sink& sink,
                    ir::Module& out);

    bool run();
    /// One module only (lowerUnit).
    bool runUnit(uint32_t task, const sema::Module& module, const UnitOptions& options);
    /// Belongs to another unit: reached by name when the program runs.
    bool isForeign(const sema::Symbol& symbol) const {
        return unit_ && !symbol.predefined && symbol.module != unit_;
    }

    /// Belongs to another module that EraseModule may take out of memory.
    bool mayBeErased(const sema::Symbol& symbol, const sema::Module* from) const {
        return erases_ && !unit_ && !symbol.predefined && symbol.module && symbol.module != from;
    }
    /// The global I32 that says whether that has happened.
    uint32_t goneFlag(const sema::Module& module, uint32_t task);
    /// A flag (i32): the variable has been assigned since the task began. For variables of modules whose initial value hangs
    /// on a name that nothing declares here.
    uint32_t valueFlag(const sema::DataSymbol& symbol, uint32_t task);
    bool hasOpenInitialValues() const { return openInitialValues_; }
    /// Some data of other modules may be absent when an instruction is executed.
    bool dataMayBeAbsent() const { return unit_ || erases_; }

    /// RaiseToUser \Continue may execute error handlers of the program.
    bool continuesAtUserLevel() const { return continuesAtUserLevel_; }

    /// Some native reaches data of the routine that calls it by name.
    bool reachesRoutineData() const { return reachesRoutineData_; }
    bool stepping() const { return options_.stepping; }

    ir::Module& module() { return module_; }
    const sema::CheckedProgram& program() const { return program_; }
    diag::Sink& sink() { return sink_; }

    ir::TypeId stringType() { return module_.stringOf(rt::kStringCapacity); }
    ir::TypeId irType(const sema::Type* type);
    ir::TypeId irType(const sema::DataType& type);
    uint32_t typeDesc(const sema::DataType& type);
    /// The global that holds module data, a constant aggregate or the slot of a signal, made on first use.
    uint32_t globalFor(const sema::DataSymbol& symbol, uint32_t task);
    uint32_t routineFor(const sema::RoutineSymbol& symbol, uint32_t task);
    ir::TypeId slotType(rt::Slot slot, const sema::DataSymbol& param);
    uint32_t nativeFor(const sema::RoutineSymbol& symbol);
    /// A native of the runtime support that has no RAPID name.
    uint32_t support(Support native);
    bool implemented(const sema::RoutineSymbol& symbol) const;
    EvaluatedCalls& evaluatedCalls() { return evaluatedCalls_; }
    /// Interned read-only data.
    uint32_t constGlobal(ir::TypeId type, ir::ConstData data);
    uint32_t stringGlobal(std::string_view text);
    /// Value of a predefined error constant.
    int32_t errorNumber(sema::LanguageError error) const;
    /// The number that means every error in the list of a handler.
    int32_t allErrors() const { return allErrors_; }
    uint32_t fileIndex(const std::string& path);
    /// The argument's name travels with this parameter, because ArgName asks for it.
    bool passesName(const sema::DataSymbol& param) const { return namedParams_.contains(&param); }
    bool asksForNames() const { return asksForNames_; }
    /// The routine works on a copy of this IN parameter.
    bool copies(const sema::DataSymbol& param) const { return copies_ && copies_->copies(param); }
    /// Layout of an argument of a call by name (rt::LateCallArg).
    ir::TypeId lateRow();
    const sema::Task& task(uint32_t index) const { return *program_.tasks[index]; }
    /// Appends the flattened constant in memory order; `None` gives zeros.
    void flatten(const sema::ConstValue& value, const sema::DataType& type, ir::ConstData& out);

  private:
    struct Pending {
        const sema::RoutineSymbol* symbol;
        uint32_t task;
        uint32_t index;
    };
    void lowerTask(uint32_t task);
    // lower_named.cpp
    const sema::RoutineSymbol* usedBuiltIn(sema::Role role) const;
    bool searchesData() const;
    void findNamedParameters();
    void findOpenInitialValues(const sema::Module& module); // lower_open.cpp
    uint32_t addFlag(std::string name);
    uint32_t addNative(ir::Native native);
    void findCopies();
    bool usesContinue() const;
    bool isGiven(const sema::RoutineSymbol& routine, std::string_view param) const;
    void addPredefinedData(uint32_t task);
    void addRoutineData(uint32_t task, const sema::Module& module);
    void addSearchTypes();
    void addNamedRoutine(const sema::RoutineSymbol& symbol, uint32_t task);
    void addTables();
    void addTablesOf(uint32_t task, const sema::Module& module, bool callsByName);
    bool isImported(const sema::DataSymbol& symbol) const;
    uint32_t importGlobal(const sema::DataSymbol& symbol, uint32_t task);
    uint32_t makeEmptyEntry(uint32_t taskIndex);
    uint32_t makeReset(uint32_t task);
    void drainPending();
    uint32_t lowerDetachedHandler(const Pending& routine, const RoutineLowering& body);
    bool inSharedModule(const sema::DataSymbol& symbol) const;
    ir::GlobalAlias aliasOf(const sema::DataSymbol& symbol, uint32_t task, uint32_t global);
    uint32_t addGlobal(const sema::DataSymbol& symbol, uint32_t task, bool shared, const std::string& name);

    const sema::CheckedProgram& program_;
    const Options& options_;
    diag::Sink& sink_;
    ir::Module& module_;
    std::unordered_map<const sema::Type*, ir::TypeId> records_;
    std::map<std::tuple<const sema::Type*, int, int, int>, uint32_t> descs_;
    std::map<std::pair<uint32_t, const sema::DataSymbol*>, uint32_t> globals_;
    std::map<std::string, uint32_t> sharedPersistents_; ///< and data of shared modules
    std::map<std::pair<uint32_t, const sema::RoutineSymbol*>, uint32_t> routines_;
    std::unordered_map<std::string, uint32_t> natives_;
    std::map<std::string, uint32_t> constants_;
    EvaluatedCalls evaluatedCalls_{options_};
    std::unordered_map<sema::LanguageError, int32_t> errorNumbers_;
    int32_t allErrors_ = ir::kEveryError;
    std::unordered_map<std::string, uint32_t> files_;
    std::vector<Pending> pending_;
    const sema::Module* unit_ = nullptr;
    const UnitOptions* unitOptions_ = nullptr;
    std::unordered_set<const sema::DataSymbol*> namedParams_;
    bool asksForNames_ = false;
    std::optional<ArgumentCopies> copies_;
    bool openInitialValues_ = false;
    const bool reachesRoutineData_;
    bool erases_ = false; ///< calls EraseModule, or loads modules, which may
    bool continuesAtUserLevel_ = false;
    std::map<std::pair<uint32_t, const sema::Module*>, uint32_t> goneFlags_;
    std::map<std::pair<uint32_t, const sema::DataSymbol*>, uint32_t> valueFlags_;
    ir::TypeId lateRow_ = ir::kVoid;
};

} // namespace rapid::lower
