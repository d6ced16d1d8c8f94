// In-memory compilation of large programs: data and tables at once, a routine when it is called first. All calls between
// parts go through a table of addresses, which at first name trampolines that order the routine. A routine without loops gets quick code
// that counts its calls; one with loops, or one that is called often, optimised code with what it calls compiled into it.
// A separate thread compiles, because tasks run on small stacks and because better code is made while the program continues.
// Results do not depend on which code runs.

#include <llvm/ADT/SmallVector.h>
#include <llvm/ExecutionEngine/Orc/IndirectionUtils.h>
#include <llvm/ExecutionEngine/Orc/OrcABISupport.h>
#include <llvm/Support/SmallVectorMemoryBuffer.h>

#include <atomic>
#include <condition_variable>
#include <cstdio>
#include <cstdlib>
#include <deque>
#include <fstream>
#include <list>
#include <mutex>
#include <string>
#include <thread>

#include "codegen/compile.h"
#include "codegen/hot_code.h"
#include "codegen/interpreted_routine.h"
#include "codegen/module_emitter.h"
#include "codegen/orc_session.h"
#include "codegen/parts.h"
#include "codegen/program_data.h"
#include "codegen/task_frame.h"
#include "ir/core/ir.h"

namespace codegen {
namespace {

#if defined(__aarch64__)
using ReentryAbi = llvm::orc::OrcAArch64;
#else
using ReentryAbi = llvm::orc::OrcX86_64_SysV;
#endif

/// Calls after which quick code is replaced.
constexpr int32_t kHotCalls = 200;

/// A debugger has started this process, or is attached to it.
bool isDebugged() {
    std::ifstream status("/proc/self/status");
    for (std::string line; std::getline(status, line);)
        if (line.rfind("TracerPid:", 0) == 0) return line.find_first_of("123456789") != std::string::npos;
    return false;
}

class LazyProgram : public JitProgram {
  public:
    LazyProgram(const ir::Module& module, const CodegenOptions& options)
        : module_(module), options_(options), slots_(module.routines.size()),
          counts_(module.routines.size(), kHotCalls), prepared_(module.routines.size(), !options.prepare),
          released_(module.routines.size(), false),
          settingTaskFrame_(std::make_shared<const std::vector<bool>>(routinesSettingTaskFrame(module, {}))),
          quality_(module.routines.size(), Quality::None) {
        // It takes longer than the code.
        options_.debugInfo = options_.debugInfo && isDebugged();
        options_.holdTable = [this](std::vector<uint32_t> table) {
            const std::lock_guard lock(tablesMutex_);
            return tables_.emplace_back(std::move(table)).data();
        };
    }

    ~LazyProgram() override {
        {
            const std::lock_guard lock(mutex_);
            ended_ = true;
        }
        changed_.notify_all();
        if (compiler_.joinable()) compiler_.join();
    }

    const rt::ProgramDesc* program() const override { return program_; }

    bool load(const std::vector<NativeSymbol>& symbols, std::string& error) {
        auto machine = makeTargetMachine(quick(), error);
        if (!machine || !session_.open(machine->createDataLayout(), options_.debugInfo, error)) return false;
        std::vector<NativeSymbol> known = symbols;
        known.push_back({kRoutineSlots, slots_.data()});
        known.push_back({kCallCounts, counts_.data()});
        known.push_back({kRoutineIsHot, reinterpret_cast<const void*>(&LazyProgram::isHot)});
        known.push_back({kThisProgram, this});
        if (ProgramData::canHold(module_)) {
            data_ = std::make_unique<ProgramData>(module_);
            if (!data_->create()) throw std::bad_alloc();
        }
        if (data_) known.insert(known.end(), data_->symbols().begin(), data_->symbols().end());
        if (!session_.define(known, error) || !makeTrampolines(error)) return false;
        Part tables;
        tables.tables = tables.callsBySlot = true;
        tables.settingTaskFrame = settingTaskFrame_;
        tables.dataInMemory = data_ != nullptr;
        auto object = objectOf(tables, quick(), error);
        if (!object || !session_.addShared(std::move(object), error)) return false;
        program_ = static_cast<const rt::ProgramDesc*>(session_.find(kProgramSymbol, error));
        if (!program_ || !describeData(error)) return false;
        compiler_ = std::thread([this] { compileOrders(); });
        return true;
    }

  private:
    enum class Quality : uint8_t { None, Quick, Optimised };

    struct Order {
        uint32_t routine;
        Quality quality;
    };

    bool describeData(std::string& error) {
        if (data_)
            data_->setTypes([&](uint32_t number) {
                return static_cast<const rt::TypeDesc*>(session_.find(typeDescSymbol(number), error));
            });
        return error.empty();
    }

    CodegenOptions quick() const {
        CodegenOptions options = options_;
        options.optimise = false;
        return options;
    }

    bool makeTrampolines(std::string& error) {
        auto pool = llvm::orc::LocalTrampolinePool<ReentryAbi>::Create(
            [this](llvm::orc::ExecutorAddr trampoline, const auto& landed) {
                landed(llvm::orc::ExecutorAddr::fromPtr(obtain(byTrampoline_.at(trampoline.getValue()))));
            });
        if (!pool) return take(pool.takeError(), error);
        trampolines_ = std::move(*pool);
        for (uint32_t i = 0; i < slots_.size(); ++i) {
            auto trampoline = trampolines_->getTrampoline();
            if (!trampoline) return take(trampoline.takeError(), error);
            byTrampoline_.emplace(trampoline->getValue(), i);
            slots_[i] = trampoline->toPtr<void*>();
        }
        return true;
    }

    /// Called by a trampoline, on the stack of a task: waits until the routine is compiled.
    void* obtain(uint32_t routine) {
        std::unique_lock lock(mutex_);
        if (quality_[routine] == Quality::None) {
            orders_.push_front({routine, Quality::Quick});
            changed_.notify_all();
            changed_.wait(lock, [&] { return quality_[routine] != Quality::None; });
        }
        return slots_[routine].load();
    }

    /// Called by quick code.
    static void isHot(LazyProgram* program, uint32_t routine) {
        const std::lock_guard lock(program->mutex_);
        program->orders_.push_back({routine, Quality::Optimised});
        program->changed_.notify_all();
    }

    void compileOrders() {
        std::unique_lock lock(mutex_);
        while (true) {
            changed_.wait(lock, [&] { return ended_ || !orders_.empty(); });
            if (ended_) return;
            const Order order = orders_.front();
            orders_.pop_front();
            if (quality_[order.routine] >= order.quality) continue;
            lock.unlock();
            const Quality made = compileRoutine(order);
            lock.lock();
            quality_[order.routine] = made;
            changed_.notify_all();
        }
    }

    Quality compileRoutine(const Order& order) {
        const ir::Routine& routine = module_.routines[order.routine];
        prepare(order.routine);
        const bool optimise =
            options_.optimise && (order.quality == Quality::Optimised || hasLoop(module_, routine));
        Part part;
        part.callsBySlot = true;
        part.routines = {order.routine};
        part.settingTaskFrame = settingTaskFrame_;
        part.countsCalls = options_.optimise && !optimise;
        if (optimise) part.copies = copiesFor(module_, part.routines, kLargestHotCopy);
        std::erase_if(part.copies, [&](uint32_t copy) { return released_[copy]; });
        for (const uint32_t copy : part.copies)
            prepare(copy);
        std::string error;
        auto object = objectOf(part, optimise ? options_ : quick(), error);
        const void* address =
            object ? session_.addPrivate(std::move(object), symbolOf(routine), error) : nullptr;
        if (!address) giveUp(order.routine, error);
        slots_[order.routine].store(const_cast<void*>(address));
        return optimise || released_[order.routine] ? Quality::Optimised : Quality::Quick;
    }

    void prepare(uint32_t routine) {
        std::string error;
        if (prepared_[routine]) return;
        if (!options_.prepare(routine, error)) giveUp(routine, error);
        prepared_[routine] = true;
    }

    /// The program is in the middle of a call that cannot be carried out.
    [[noreturn]] void giveUp(uint32_t routine, const std::string& error) const {
        std::fprintf(stderr, "rapidc: internal error: %s cannot be compiled: %s\n",
                     module_.routines[routine].name.c_str(), error.c_str());
        std::fflush(nullptr);
        std::_Exit(kInternalError);
    }

    std::unique_ptr<llvm::MemoryBuffer> objectOf(const Part& part, const CodegenOptions& options,
                                                 std::string& error) {
        auto machine = makeTargetMachine(options, error);
        if (!machine) return nullptr;
        llvm::LLVMContext context;
        auto compiled = compile(module_, options, *machine, context, error, &part);
        if (compiled) releaseInterpreted(part.routines);
        llvm::SmallVector<char, 0> bytes;
        if (!compiled || !generate(*compiled, *machine, llvm::CodeGenFileType::ObjectFile, bytes, error))
            return nullptr;
        return std::make_unique<llvm::SmallVectorMemoryBuffer>(std::move(bytes), module_.name, false);
    }

    /// The words and what LLVM makes of them need as much memory again as the instructions.
    void releaseInterpreted(const std::vector<uint32_t>& routines) {
        for (const uint32_t routine : routines) {
            if (!options_.release || !isInterpreted(module_, module_.routines[routine], options_)) continue;
            released_[routine] = true;
            options_.release(routine);
        }
    }

    static constexpr int kInternalError = 2;

    const ir::Module& module_;
    CodegenOptions options_;
    std::unique_ptr<ProgramData> data_; ///< null: in the tables
    OrcSession session_;
    std::vector<std::atomic<void*>> slots_;
    std::vector<int32_t> counts_;
    std::unique_ptr<llvm::orc::LocalTrampolinePool<ReentryAbi>> trampolines_;
    std::unordered_map<uint64_t, uint32_t> byTrampoline_;
    std::vector<bool> prepared_; ///< used by the compiling thread
    std::vector<bool> released_; ///< as well: their instructions are gone, the code remains
    std::shared_ptr<const std::vector<bool>> settingTaskFrame_;
    std::mutex tablesMutex_;
    std::list<std::vector<uint32_t>> tables_; ///< of interpreted routines
    const rt::ProgramDesc* program_ = nullptr;
    std::mutex mutex_; ///< of what follows
    std::condition_variable changed_;
    std::vector<Quality> quality_;
    std::deque<Order> orders_;
    bool ended_ = false;
    std::thread compiler_;
};

static_assert(sizeof(std::atomic<void*>) == sizeof(void*) && std::atomic<void*>::is_always_lock_free);

} // namespace

std::unique_ptr<JitProgram> lazyJit(const ir::Module& module, const CodegenOptions& options,
                                    const std::vector<NativeSymbol>& symbols, std::string& error) {
    const SymbolTable table = tableOf(symbols);
    std::vector<std::string> missing;
    std::vector<NativeSymbol> present;
    for (const NativeSymbol& symbol : symbols)
        if (symbol.address) present.push_back(symbol);
    for (const ir::Native& native : module.natives) {
        const auto found = table.find(native.symbol);
        if ((found == table.end() || !found->second) && native.symbol.starts_with("rt_"))
            missing.push_back(native.symbol);
    }
    if (!missing.empty()) {
        error = notImplemented(missing);
        return nullptr;
    }
    auto program = std::make_unique<LazyProgram>(module, options);
    if (!program->load(present, error)) return nullptr;
    return program;
}

} // namespace codegen
