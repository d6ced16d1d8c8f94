#pragma once
// IR module -> LLVM module: declarations, data, run-time tables. The bodies are RoutineEmitter's.

#include <llvm/IR/IRBuilder.h>
#include <llvm/IR/MDBuilder.h>
#include <llvm/IR/Module.h>

#include <map>
#include <memory>
#include <string>
#include <tuple>
#include <unordered_map>
#include <vector>

#include "codegen/abi_types.h"
#include "codegen/codegen.h"
#include "codegen/data_image.h"
#include "codegen/debug_info.h"
#include "ir/core/ir.h"
#include "runtime/abi/rt_abi.h"

namespace codegen {

/// The part of a program that one LLVM module contains, of a program that is compiled in several.
struct Part {
    bool tables = false;            ///< data, tables, C entries
    std::vector<uint32_t> routines; ///< that other parts call
    std::vector<uint32_t> copies;   ///< of routines of other parts, to be inlined
    /// routinesSettingTaskFrame() of the program, made once for all parts.
    std::shared_ptr<const std::vector<bool>> settingTaskFrame;
    bool isPaced = false; ///< `routines` are all paced by natives: they get the fastest code generation, too
    // In memory only:
    bool countsCalls = false; ///< of `routines`, in the table kCallCounts
    bool callsBySlot = false; ///< other parts are reached through the table kRoutineSlots
    /// Tables: the program's data and the rows that list them are there already (ProgramData).
    bool dataInMemory = false;
};
/// Their rows (rt::GlobalDesc) then.
inline constexpr const char* kDataRows = "rapidc.data";
inline constexpr const char* kAliasRows = "rapidc.aliases";
/// Table of the present addresses of all routines, and that of their countdowns (int32_t): the call that brings one to 0
/// reports the routine to kRoutineIsHot(program, uint32_t).
inline constexpr const char* kRoutineSlots = "rapidc.slots";
inline constexpr const char* kCallCounts = "rapidc.counts";
inline constexpr const char* kRoutineIsHot = "rapidc.hot";
inline constexpr const char* kThisProgram = "rapidc.this"; ///< its first argument
/// Symbol of the description of a type, of its number in Module::typeDescs.
std::string typeDescSymbol(uint32_t index);

/// Metadata that keeps accesses to program data, to the task and to frame records apart.
struct AccessTags {
    llvm::MDNode* data[ir::kScalarTypes] = {}; ///< by scalar TypeId
    llvm::MDNode* task = nullptr;
    llvm::MDNode* frame = nullptr;
    llvm::MDNode* root = nullptr;
};

/// Fills the frame record and calls rt_safepoint; what follows the frame goes into the record.
using SafepointSlow = rt::Status(rt::TaskCore*, rt::Frame* frame, rt::Frame* caller, const rt::RoutineDesc*,
                                 int32_t statement);

/// The runtime's functions.
struct RuntimeParts {
    abi::Callee<decltype(rt_safepoint)> safepoint;
    abi::Callee<decltype(rt_raise)> raise;
    abi::Callee<decltype(rt_nativeFailed)> nativeFailed;
    abi::Callee<decltype(rt_land)> land;
    abi::Callee<decltype(rt_takesError)> takesError;
    abi::Callee<decltype(rt_propagate)> propagate;
    abi::Callee<decltype(rt_handlerEnd)> handlerEnd;
    abi::Callee<decltype(rt_retry)> retry;
    abi::Callee<decltype(rt_stackOverflow)> stackOverflow;
    abi::Callee<decltype(rt_step)> step;
    abi::Callee<decltype(rt_chargeLater)> chargeLater;
    abi::Callee<SafepointSlow> safepointSlow; ///< own function that keeps all registers
};

/// The locals that a routine of the stepping profile describes, in the order of their table: numbers in
/// Routine::locals.
std::vector<uint32_t> describedLocals(const ir::Routine& routine);
/// Those, then the ones its detached handler reaches: what SteppingFrame::addresses names.
std::vector<uint32_t> addressedLocals(const ir::Routine& routine);

// Size: the tables of a program refer to each other; one object holds the LLVM module they are built in.
class ModuleEmitter {
  public:
    /// `part`: null for the whole program.
    ModuleEmitter(const ir::Module& module, const CodegenOptions& options, llvm::LLVMContext& context,
                  const Part* part = nullptr);
    std::unique_ptr<llvm::Module> run(const llvm::DataLayout& layout, const std::string& triple);

    const ir::Module& source() const { return module_; }
    const CodegenOptions& options() const { return options_; }
    llvm::LLVMContext& context() { return context_; }
    llvm::Module& target() { return *target_; }
    DebugInfo* debug() { return debug_.get(); }

    /// Register type of a scalar (Bool: i1) and the type it has in memory and in C signatures (Bool: i8).
    llvm::Type* valueType(ir::TypeId type);
    llvm::Type* memoryType(ir::TypeId type);
    const AccessTags& tags() const { return tags_; }
    /// Of a scalar that lies at `offset` of a record: accesses to other components of such records are other memory.
    llvm::MDNode* componentTag(ir::TypeId record, uint32_t offset, ir::TypeId scalar);
    const RuntimeParts& runtime() const { return runtime_; }
    llvm::MDNode* unlikely() {
        return unlikely_;
    } ///< weights of a branch whose first target is the usual one

    // Declared when they are used first.
    llvm::Function* routine(uint32_t index);
    llvm::Function* nativeFunction(uint32_t index);
    /// Notes the statement, calls the native, reports its error, and then calls the runtime when the budget is used up. `fastcc`;
    /// arguments: the task, the number of the statement, those of the native. Returns 0 or the outcome of the error.
    /// `absent`: by argument of the native (the first is the task); it is 0 or null and not passed.
    llvm::Function* checkedNative(uint32_t index, bool thenSafepoint, const std::vector<bool>& absent);
    bool setsTaskFrame(uint32_t routine) const { return (*settingTaskFrame_)[routine]; }
    /// Its body is known and looks at no frame record (codegen/bodies).
    bool isSelfContained(const ir::Native& native) const;
    llvm::GlobalVariable* global(uint32_t index);
    llvm::GlobalVariable* typeDesc(uint32_t index);
    llvm::GlobalVariable* routineDesc(uint32_t index);
    /// The entry with the C calling convention of an exported routine.
    llvm::Function* cEntry(uint32_t index);
    /// The callee of a call of the routine at the place of the builder.
    llvm::FunctionCallee callee(llvm::IRBuilderBase& b, uint32_t index);
    bool countsCalls(uint32_t index) const;

  private:
    // module_emitter.cpp
    void declareTypes();
    llvm::MDNode* accessNode(ir::TypeId type);
    void declareRuntime();
    /// Of what other parts refer to, and of what they do not.
    void share(llvm::GlobalValue& value) const;
    bool isShared(const ir::Global& global) const;
    bool hasTables() const { return part_ == nullptr || part_->tables; }
    bool dataInMemory() const { return part_ != nullptr && part_->dataInMemory; }
    void emitBodies();
    void emitSafepointSlow();
    void emitCEntry(uint32_t index);
    llvm::Function* emitStart(uint32_t index);
    /// The entry that takes its arguments out of a table (rt::LateEntry).
    llvm::Function* emitLateEntry(const ir::NamedRoutine& named);
    llvm::Constant* initialValue(const ir::Global& global);
    // emit_tables.cpp
    llvm::GlobalVariable* tableVariable(std::vector<llvm::GlobalVariable*>& known, uint32_t index,
                                        llvm::Type* type, const std::string& name);
    void emitTables();
    llvm::Constant* text(const std::string& value);
    llvm::Constant* constant(llvm::Constant* value, const std::string& name);
    /// A private array and its address; null when empty.
    llvm::Constant* array(llvm::Type* element, const std::vector<llvm::Constant*>& values,
                          const std::string& name);
    /// The same for rows of T.
    template <class T>
    llvm::Constant* table(const std::vector<llvm::Constant*>& rows, const std::string& name) {
        return array(abi::structType<T>(context_), rows, name);
    }
    /// The same for rows without addresses: the bytes as they lie in memory (code is made for the host's architecture). There are
    /// many statements, and a constant of LLVM for each field takes a large part of the time.
    template <class T> llvm::Constant* rawTable(const std::vector<T>& rows, const std::string& name) {
        static_assert(std::has_unique_object_representations_v<T>);
        return rawArray({reinterpret_cast<const char*>(rows.data()), rows.size() * sizeof(T)}, alignof(T),
                        name);
    }
    llvm::Constant* rawArray(llvm::StringRef bytes, size_t align, const std::string& name);
    llvm::Constant* fileName(uint32_t file);
    llvm::Constant* i32(int64_t value);
    llvm::Constant* null();
    llvm::Constant* typeDescOrNull(uint32_t index); ///< null for ir::kNone
    llvm::Function* entryOrNull(uint32_t routine);  ///< the same for the C entry of a routine
    llvm::Constant* typeDescValue(const ir::TypeDesc& desc);
    llvm::Constant* statementTable(const ir::Routine& routine);
    std::vector<llvm::Constant*> localRows(const ir::Routine& routine);
    llvm::Constant* routineDescValue(const ir::Routine& routine);
    llvm::Constant* tasks();
    llvm::Constant* dataRow(const DataDeclaration& declared);
    /// `symbol`: the rows when they are in memory already.
    llvm::Constant* dataTable(const std::vector<DataDeclaration>& data, const char* symbol);
    llvm::Constant* externals();
    llvm::Constant* routineTable(uint32_t& count);
    std::vector<llvm::Constant*> paramRows(const ir::NamedRoutine& named);
    llvm::Constant* routineRow(uint32_t index, const ir::NamedRoutine& named);
    llvm::Constant* moduleTable();
    llvm::Constant* routineDataTable();
    void emitProgram();

    const ir::Module& module_;
    const CodegenOptions& options_;
    llvm::LLVMContext& context_;
    const Part* part_;
    std::vector<bool> defined_, copied_, exported_; ///< routines, by index; those of `part_`
    std::unique_ptr<llvm::Module> target_;
    std::unique_ptr<DebugInfo> debug_;
    AccessTags tags_;
    std::unordered_map<ir::TypeId, llvm::MDNode*> accessNodes_; ///< of records
    RuntimeParts runtime_;
    llvm::MDNode* unlikely_ = nullptr;
    std::vector<llvm::Function*> routines_, natives_, cEntries_;
    std::map<std::tuple<uint32_t, bool, std::vector<bool>>, llvm::Function*> checkedNatives_;
    std::shared_ptr<const std::vector<bool>> settingTaskFrame_;
    std::vector<llvm::GlobalVariable*> globals_, typeDescs_, routineDescs_;
    std::unordered_map<std::string, llvm::Constant*> texts_;
    llvm::PointerType* ptr_ = nullptr;
    llvm::IntegerType *i32_ = nullptr, *i64_ = nullptr, *i8_ = nullptr;
};

} // namespace codegen
