#pragma once
// Recovery strategies: each explains one kind of mistake by an edit of the tokens.

#include "frontend/diag/messages/syntax.h"
#include "frontend/syntax/grammar/parser_part.h"

#include <optional>

namespace rapid::syntax {

/// Places where the grammar does not continue, or where a name may have been meant as something else.
enum class Place : uint8_t {
    Declaration,   ///< of a module, at a name
    Component,     ///< at a name, VAR, PERS or CONST where a component of a record begins
    Data,          ///< at a name where the data of a routine is declared
    ListEnd,       ///< at a name that begins an instruction: END words that were cut off
    ListWord,      ///< there: words that continue or end the list
    ListBrace,     ///< at '}' there
    StrayWord,     ///< at a word that ends a list of instructions, but not this one
    Instruction,   ///< at the first of two names that begin an instruction
    Comment,       ///< at the first token of an instruction: text without '!'
    Braces,        ///< at '{' where a block may begin
    BlockHead,     ///< after the condition of IF or WHILE
    Counter,       ///< after FOR
    AfterCounter,  ///< after the loop variable
    Branch,        ///< at ELSE in an IF, CASE in a TEST
    ElseBody,      ///< after ELSE
    AfterCall,     ///< after what was read as a call
    Operator,      ///< after an operand
    Word,          ///< where a keyword is expected
    ListSeparator, ///< at ';' between brackets
    CaseValue,     ///< after a value of CASE
    Argument,      ///< at the first sign of an argument
    ArgumentComma, ///< at ',' before an argument
    Parameter,     ///< at the first sign of a parameter
    Assignment,    ///< at ':' after the target of an assignment or the name of an argument
    Count
};

/// The place, and what the parser knows there.
struct Situation {
    Place place;
    TokenSet own = {}; ///< ListEnd, ListWord, ListBrace, StrayWord: the words that continue or end the list
    const Expr* left = nullptr; ///< Operator: the operand
    TokenIndex word = kNoToken; ///< AfterCall: the callee; BlockHead, Counter: the word that began the block
    TokenKind expected = TokenKind::EndOfFile; ///< Word: the keyword; ListSeparator: the closing bracket
};

/// An edit of the tokens, and the diagnostic that it explains.
struct Repair {
    unsigned cost = 1; ///< letters, signs or words that are other than they should be
    TokenIndex first = 0, last = 0;
    /// The tokens `first` to `last` are read as this kind, in the place of `last`. Error: they are left out.
    TokenKind as = TokenKind::Error;
    TokenIndex next = 0; ///< where the parser reads on
    /// Reported without `args`: what MisspeltWords::readAsKeyword() says.
    diag::Code code = diag::say::MisspeltKeyword.code;
    SourceRange range = {};
    std::vector<std::string> args = {};
    std::optional<TextEdit> edit = {}; ///< of the text
    bool certain = true;
    bool silent = false;   ///< it is reported where the consequence shows
    bool endsList = false; ///< StrayWord: the list ends here
    TokenIndex noteAt = kNoToken;
    std::string note = {};
    bool unclear = false; ///< nothing follows from names and types in the line
    std::optional<Mark> mark = {};
    TokenIndex marked = kNoToken; ///< what has the mark; `first` unless given
};

/// One kind of mistake. Strategies have no state; what they look at is bounded by Lookahead and BlockContext.
class RecoveryStrategy : public ParserPart {
  public:
    using ParserPart::ParserPart;
    virtual ~RecoveryStrategy() = default;
    /// The edit that would explain the mistake; nothing when it was another one. Changes and reports nothing.
    virtual std::optional<Repair> propose(const Situation& at) const = 0;

  protected:
    using Proposal = std::optional<Repair>;

    /// The tokens `first` to `last` were meant as this keyword.
    static Repair keyword(TokenIndex first, TokenIndex last, K word, unsigned cost = 1) {
        return {.cost = cost, .first = first, .last = last, .as = word, .next = last};
    }
    /// The name at `i` was meant as one of these keywords: the one with the fewest edits, the first of several.
    Proposal nearest(TokenIndex i, std::initializer_list<K> words) const;
    /// The sign at the current token was meant as another one, written `text`.
    Repair sign(K as, diag::Message<2> message, std::string shown, std::string expected,
                std::string text) const;
    /// The tokens from the current one up to `next` are too many; removing `text` corrects it.
    template <size_t N>
    Repair leaveOut(TokenIndex next, diag::Message<N> message, diag::MessageArgs<N> args,
                    SourceRange text) const {
        return leaveOutAs(next, message.code, {args, args + N}, text);
    }

  private:
    Repair leaveOutAs(TokenIndex next, diag::Code code, std::vector<std::string> args,
                      SourceRange text) const;
};

/// The strategies of one parser, by place, the likelier ones first.
class StrategyTable {
  public:
    template <class Strategy> void add(Place place, Parser& parser) {
        places_[static_cast<size_t>(place)].push_back(std::make_unique<Strategy>(parser));
    }
    const std::vector<std::unique_ptr<RecoveryStrategy>>& at(Place place) const {
        return places_[static_cast<size_t>(place)];
    }

  private:
    std::array<std::vector<std::unique_ptr<RecoveryStrategy>>, static_cast<size_t>(Place::Count)> places_;
};

void addWordStrategies(StrategyTable& table, Parser& parser);      ///< misspelt and foreign keywords
void addListWordStrategies(StrategyTable& table, Parser& parser);  ///< words that continue or end a list
void addStrayWordStrategies(StrategyTable& table, Parser& parser); ///< words that end no list here
void addBlockStrategies(StrategyTable& table, Parser& parser);     ///< heads and branches of blocks
void addSignStrategies(StrategyTable& table, Parser& parser);      ///< punctuation, operators, comments

/// Asks the strategies of a place. The cheapest proposal wins, of equal ones that of the earlier strategy; none is
/// cheaper than 1.
class Recovery : public ParserPart {
  public:
    using ParserPart::ParserPart;

    /// Null when no strategy explains the mistake. Otherwise it is reported and the tokens are edited; the parser looks
    /// again at the current one. The pointer is valid until the next call.
    const Repair* repair(const Situation& at);
    const Repair* repair(Place place) { return repair(Situation{.place = place}); }

  private:
    void apply(const Repair& repair);

    std::optional<Repair> applied_;
    std::unique_ptr<StrategyTable> table_; ///< made when the first one is needed
};

} // namespace rapid::syntax
