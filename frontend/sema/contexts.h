#pragma once
// The subject of a check: module, routine, task. Contexts are values: they are made, kept, compared and dropped.

#include "frontend/sema/checker.h"
#include "frontend/sema/names.h"

#include <optional>
#include <unordered_map>
#include <unordered_set>
#include <utility>

namespace rapid::sema {

using diag::Code;
namespace say = diag::say;

/// The place of the check: a module, and in it perhaps a routine.
struct Context {
    Module* module = nullptr;
    const syntax::SyntaxTree* tree = nullptr;
    ExprTable* exprs = nullptr;
    RoutineSymbol* routine = nullptr; ///< null at module level
    bool constant = false;            ///< inside a constant expression
    bool operator==(const Context&) const = default;
};

enum class Part : uint8_t { Body, Backward, Error, Undo };

/// The use of an optional parameter by its routine.
struct OptionalUse {
    const syntax::Expr* first = nullptr; ///< first reference outside Present and conditional arguments
    bool tested = false;                 ///< by Present
    bool operator==(const OptionalUse&) const = default;
};

/// A label or a jump, judged when the whole routine is known.
struct JumpPoint {
    NameId name = 0;
    uint32_t block = 0;
    Part part = Part::Body;
    const syntax::Node* node = nullptr;
    LabelSymbol* label = nullptr;
    bool operator==(const JumpPoint&) const = default;
};

/// Names that many comparisons with others cost time: so many are compared in a task, and in a routine.
inline constexpr size_t kMaxUnknown = 2000; ///< so many messages about unknown names are not read
inline constexpr size_t kMaxComparisons = 4'000'000, kMaxPartComparisons = 200'000;

/// RoutineContext::block outside of all blocks.
inline constexpr uint32_t kNoBlock = 0xFFFFFFFFu;

/// The routine that is being checked, or was last.
struct RoutineContext {
    Part part = Part::Body;
    unsigned loopDepth = 0;
    bool breakSeen = false;
    bool returnSeen = false;
    bool broken = false;           ///< an instruction could not be read
    bool blocksAreUnclear = false; ///< a line could not be read: perhaps the word of a block
    uint32_t block = kNoBlock;
    std::vector<uint32_t> blockParents;
    std::vector<JumpPoint> labels;
    NameMap<LabelSymbol> labelNames;
    std::vector<JumpPoint> gotos;
    std::unordered_set<NameId> jumpNames; ///< after GOTO, once they are asked for
    bool jumpNamesKnown = false;
    std::unordered_set<NameId> unknownRoutines;       ///< reported
    std::vector<OptionalUse> optionalUses;            ///< by index of the parameter
    size_t partComparisonsLeft = kMaxPartComparisons; ///< of labels, components and parameters
    const RoutineSymbol* wideRoutine = nullptr;       ///< one with very many parameters, and their names
    NameMap<DataSymbol> wideNames;
};

/// A file of a task: where its tree and facts are in the program, and its modules.
struct TaskFile {
    size_t slot = 0;
    bool broken = false; ///< it has syntax errors
    std::vector<Module*> modules;
    bool operator==(const TaskFile&) const = default;
};

/// A name that nothing declares, reported.
struct UnknownName {
    const Module* module = nullptr;
    NameId name = 0;
    Code code{};
    diag::CauseId cause{}; ///< of the diagnostic
    SourceRange where;
    bool looksMisspelt = false;
    /// The declaration with the most similar name; data of routines only while their file is checked.
    const Symbol* near = nullptr;
    bool explained = false; ///< by a declaration that lost its name
};

/// The numbers that an undeclared name is compared with.
struct ComparedName {
    double least = 0, most = 0;
    bool fraction = false; ///< one of them is not an integer
    bool unknown = false;  ///< of one the value is not known

    bool operator==(const ComparedName&) const = default;
    void add(const ComparedName& other) {
        least = std::min(least, other.least);
        most = std::max(most, other.most);
        fraction |= other.fraction;
        unknown |= other.unknown;
    }
};

/// How the routines of a file use names that nothing declares. Refers to no other file, so that it stays when others change.
struct FileSignalUses {
    std::unordered_map<NameId, const Type*>
        arguments; ///< for parameters of a signal type; the first use counts
    std::unordered_map<NameId, ComparedName> compared;
    std::vector<std::pair<NameId, NameId>>
        comparedWith;                  ///< a name, and one that counts if it is known as a signal
    std::unordered_set<NameId> others; ///< assigned, calculated with, or declared in some routine
    bool operator==(const FileSignalUses&) const = default;
};

/// The same for the task; put together when the first of the names is met.
struct SignalUses {
    bool known = false;
    NameMap<const Type> arguments;
    std::unordered_map<NameId, ComparedName> compared;
    std::vector<std::shared_ptr<const FileSignalUses>> files;
};

/// The names that a task declares: its tables by NameId are large and nearly empty.
struct NameLists {
    std::vector<NameId> global, configured; ///< ascending
    std::unordered_set<NameId> ofModules;   ///< LOCAL and global ones
};

/// A file as others see it beyond its declarations. As long as it stays the same, files that are `open` keep their outcome.
struct FileOffer {
    std::vector<const Symbol*> used; ///< sorted; without those of routines
    std::shared_ptr<const FileSignalUses> uses;
    Spent spent;
};

/// Facts about a task. A Session keeps them between checks.
struct TaskContext {
    Task* task = nullptr;
    std::vector<TaskFile> files;
    std::vector<Symbol*> globals;                   ///< by NameId
    std::vector<DataSymbol*> configured;            ///< signals and mechanical units, by NameId
    std::vector<DataSymbol*> assumed, spareAssumed; ///< of these: those known by their use only; old ones
    NameMap<Module> moduleNames;
    bool incomplete = false;                 ///< modules are missing: names may be unknown
    std::vector<std::string> missingModules; ///< their names, as far as they are known
    bool bindsLate = false;                  ///< BindRef is off: names are looked for during execution
    /// The outcome depends on the order of the work: no file can be checked alone.
    bool dependsOnOrder = false;
    SignalUses signalUses;
    std::vector<const syntax::SyntaxTree*> brokenTrees; ///< with syntax errors
    std::unordered_set<NameId> maybeDeclared;           ///< names in declarations that could not be read
    std::optional<NameLists> nameLists;                 ///< see Suggestions::nameLists
    std::unordered_set<NameId> reportedNames;           ///< unknown signals and options, reported once
    std::vector<UnknownName> unknownNames;              ///< of the files that are being checked
    std::vector<UnknownName> earlierUnknownNames;       ///< of those that have been: Repeats::gatherUnknown
    size_t comparisonsLeft = kMaxComparisons;           ///< of names with misspelt ones
    Spent elsewhere;                                    ///< by files before the one that is checked alone
    bool isLoose = false; ///< something was spent outside the check of the files
};

} // namespace rapid::sema
