#pragma once
// The analysis of check(): an Analyzer works through the library and then each task. Internal to frontend/sema.

#include "frontend/sema/across_tasks.h"
#include "frontend/sema/argument_order.h"
#include "frontend/sema/arguments.h"
#include "frontend/sema/availability.h"
#include "frontend/sema/call.h"
#include "frontend/sema/collect.h"
#include "frontend/sema/entry.h"
#include "frontend/sema/expr.h"
#include "frontend/sema/fold.h"
#include "frontend/sema/jumps.h"
#include "frontend/sema/parts.h"
#include "frontend/sema/place.h"
#include "frontend/sema/remedies.h"
#include "frontend/sema/repeats.h"
#include "frontend/sema/resolve_data.h"
#include "frontend/sema/resolve_types.h"
#include "frontend/sema/routine.h"
#include "frontend/sema/scopes.h"
#include "frontend/sema/signal_uses.h"
#include "frontend/sema/stmt.h"
#include "frontend/sema/stmt_flow.h"
#include "frontend/sema/suggestions.h"
#include "frontend/sema/unknown.h"

namespace rapid::sema {

class Analyzer {
  public:
    Analyzer(CheckedProgram& program, const CheckOptions& options, diag::Sink& sink);
    Analyzer(const Analyzer&) = delete;

    void loadLibrary();
    void checkTask(const TaskInput& input);
    /// Checks across tasks: persistents and modules they share.
    void checkAcrossTasks() { comparison_.checkAcrossTasks(); }

    // ---- the steps of checkTask(), for a Session (analyzer.cpp, recheck.cpp)
    void startTask(const TaskInput& input);
    /// `declare`: the modules of each file at once, while its tree is in the cache.
    void readFiles(const TaskInput& input, bool declare);
    void checkFiles();
    void finishTask();
    TaskContext leaveTask();
    void enterTask(TaskContext task);
    /// How far the modules of a file look as before.
    enum class Likeness : uint8_t { None, FromOutside, WithLocals };
    /// Takes another tree for a file of the task.
    Likeness replaceTree(size_t file, std::unique_ptr<syntax::SyntaxTree> tree, bool broken);
    /// Checks some files again while the facts about the others stay. `elsewhere`: what others are taken to have spent.
    void recheckFiles(std::span<const size_t> files, Spent elsewhere = {});
    /// Declarations of a changed file, and the bodies of the routines around `offset` only; a check of the file has to follow.
    void sketchFile(size_t file, uint32_t offset);
    /// Counts the predefined names that a file uses as used until releaseUses(), though its facts are dropped. Before replaceTree().
    std::vector<Symbol*> holdUses(size_t file);
    void releaseUses(std::span<Symbol* const> held);
    /// Whether a changed file can be checked alone although others are `open`. Not when these share reports or signals.
    bool allowsAlone() const;
    /// Before replaceTree().
    FileOffer offerOf(size_t file) const;
    /// Checks a changed file alone. False: what others may have taken from it has changed, so they have to be checked, too.
    bool recheckAlone(size_t file, const FileOffer& before);
    /// Checks the whole task again, without parsing.
    void recheckTask();
    const TaskContext& task() const { return state_.task; }

    void keepFacts() { state_.keepsFacts = true; }
    /// Session::setGuest.
    void setGuest(const std::string& guest, const std::string& host) {
        state_.guest = state_.names.intern(guest);
        state_.host = state_.names.intern(host);
        state_.hasGuest = true;
    }
    /// Before the first task: all of them, because each can name the others.
    void setTaskNames(std::vector<std::string> names) { state_.taskNames = std::move(names); }

  private:
    void readFile(const std::shared_ptr<const SourceFile>& file);
    void setMissingModules(const TaskInput& input);
    /// A task that may lack its entry routine, and does, is not part of the program.
    bool leaveOut(const TaskInput& input);
    void resolveDeclarations(std::span<Module* const> modules);
    void checkModules(std::span<Module* const> modules);
    /// `said`: how much had been reported before.
    void finishFile(std::span<Module* const> modules, size_t said);
    void listSignals();
    void dropFacts(std::span<const size_t> files);
    void renewFacts(const TaskFile& file, std::shared_ptr<FileSymbols> symbols);
    std::vector<Module*> declareAgain(std::span<const size_t> files);
    void clearLooseEnds();
    void findBrokenTrees();
    Spent spentBy(size_t files) const;

    State state_;
    Parts parts_{scopes_,  collector_,  suggestions_, signals_,  unknown_,      types_, data_,
                 folding_, places_,     expressions_, remedies_, availability_, calls_, arguments_,
                 order_,   statements_, flow_,        jumps_,    routines_};
    Scopes scopes_{state_};
    Collector collector_{state_};
    Suggestions suggestions_{state_, parts_};
    SignalFinder signals_{state_, parts_};
    UnknownNames unknown_{state_, parts_};
    TypeResolver types_{state_, parts_};
    DataResolver data_{state_, parts_};
    Folding folding_{state_};
    Places places_{state_, parts_};
    Expressions expressions_{state_, parts_};
    Remedies remedies_{state_, parts_};
    Availability availability_{state_};
    CallBinder calls_{state_, parts_};
    Arguments arguments_{state_, parts_};
    ArgumentOrder order_{state_, parts_};
    Statements statements_{state_, parts_};
    FlowStatements flow_{state_, parts_};
    Jumps jumps_{state_, parts_};
    RoutineChecker routines_{state_, parts_};
    EntryCheck entry_{state_, parts_};
    Repeats repeats_{state_, parts_};
    TaskComparison comparison_{state_};
};

} // namespace rapid::sema
