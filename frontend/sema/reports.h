#pragma once
// Where the parts of a check report: to the sink, to a list of their own while a call is judged, or nowhere.

#include "frontend/sema/contexts.h"

namespace rapid::sema {

class Reports {
  public:
    Reports(diag::Sink& sink, const Context& context) : sink_(sink), context_(context) {}

    /// In the file of the context, with a cause of its own. What seems wrong in a line that could not be read is left out.
    diag::Diagnostic& report(Code code, SourceRange where, std::span<const std::string> args);
    bool isUnclear(SourceRange where) const;
    bool hasUnclearLine(const syntax::Node& node) const;
    /// Whether `diagnostic`, which report() gave, is left out.
    bool isUnsaid(const diag::Diagnostic& diagnostic) const { return &diagnostic == &unsaid_; }

    /// In what could not be read as a whole, which is reported. Gives what was before.
    bool mute(bool muted) { return std::exchange(muted_, muted); }
    /// What is wrong with the arguments of the call being checked goes to `sink`; null: not in a call. Gives what was before.
    diag::Sink* collectIn(diag::Sink* sink) { return std::exchange(collect_, sink); }
    diag::Sink* collected() const { return collect_; }
    /// The rest of a line of the routine that was meant in another way, which is reported.
    void setQuietLine(SourceRange line) { quietLine_ = line; }
    SourceRange quietLine() const { return quietLine_; }

  private:
    diag::Sink& sink_;
    const Context& context_;
    diag::Sink* collect_ = nullptr;
    SourceRange quietLine_;
    bool muted_ = false;
    uint32_t lastCause_ = 0;
    diag::Diagnostic unsaid_;
};

} // namespace rapid::sema
