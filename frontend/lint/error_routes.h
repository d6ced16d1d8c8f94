#pragma once
// Errors that a caller means to handle but never gets: they do not leave a routine without error handler (manual 1.12).
// Internal to frontend/lint.

#include "frontend/lint/facts.h"

namespace rapid::lint {

/// Collects what routines raise, call and handle, file by file; judges when all are known.
class ErrorRoutes {
  public:
    void routine(const sema::RoutineSymbol& routine);
    /// One report for each routine that lacks a handler, at the first call whose handler names its error, or, for errors
    /// that only a program raises, takes every error.
    void judge(Reporter& reporter) const;

  private:
    struct Error {
        const sema::Symbol* variable = nullptr; ///< a booked number in module data; null: `number`
        double number = 0;
        sema::Meaning meaning = sema::Meaning::None;
        sema::LanguageError languageError = sema::LanguageError::None;
        std::string name; ///< as written
        SourceRange where;
        bool isSame(const Error& other) const {
            return variable == other.variable && (variable != nullptr || number == other.number);
        }
    };
    struct Call {
        const sema::RoutineSymbol* callee = nullptr;
        SourceRange where;
    };
    struct Routine {
        const sema::RoutineSymbol* symbol = nullptr;
        bool hasHandler = false;
        bool passesOn = false; ///< its handler raises
        bool takesAll = false; ///< its handler has no list and does not look at ERRNO
        bool callsByName = false;
        bool divides = false;       ///< by something that may be 0
        std::vector<Error> handled; ///< that it compares ERRNO with
        std::vector<Error> raised;  ///< by RAISE in the body
        std::vector<std::string>
            fromNatives; ///< names of the errors that instructions in the body can raise, in upper case
        std::vector<Call> calls;                 ///< of routines of the program, in the body
        bool canRaise(const Error& error) const; ///< by instructions in the body
    };
    /// The errors that the routines which a call leads to, through routines without handler, cannot pass on.
    struct Lost {
        const Routine* raiser = nullptr;
        const Error* error = nullptr;     ///< raised by RAISE; null: by an instruction
        std::vector<const Routine*> path; ///< without handler, the raiser last
    };

    void body(const syntax::Node& node, const sema::Module& module, Routine& out) const;
    void handler(const syntax::Node& node, const sema::Module& module, Routine& out) const;
    static Error errorOf(const syntax::Expr& number, const sema::Module& module);
    const Routine* find(const sema::RoutineSymbol* symbol) const;
    bool find(const Routine& routine, const Routine& caller, Lost& lost) const;
    bool hasOtherSource(const Routine& caller, const Error& error) const;
    bool isListed(const Error& error) const;

    std::vector<Routine> routines_;
    std::unordered_map<const sema::RoutineSymbol*, size_t> index_;
    std::vector<Error> listed_; ///< numbers in lists of handlers: these errors travel
    bool allListed_ = false;
};

} // namespace rapid::lint
