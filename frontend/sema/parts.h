#pragma once
// The parts of a check, for those that call them. A part keeps references to those it needs and no others.

namespace rapid::sema {

class ArgumentOrder;
class Arguments;
class Availability;
class CallBinder;
class Collector;
class DataResolver;
class Expressions;
class FlowStatements;
class Folding;
class Jumps;
class Places;
class Remedies;
class RoutineChecker;
class Scopes;
class SignalFinder;
class Statements;
class Suggestions;
class TypeResolver;
class UnknownNames;

struct Parts {
    Scopes& scopes;
    Collector& collector;
    Suggestions& suggestions;
    SignalFinder& signals;
    UnknownNames& unknown;
    TypeResolver& types;
    DataResolver& data;
    Folding& folding;
    Places& places;
    Expressions& expressions;
    Remedies& remedies;
    Availability& availability;
    CallBinder& calls;
    Arguments& arguments;
    ArgumentOrder& order;
    Statements& statements;
    FlowStatements& flow;
    Jumps& jumps;
    RoutineChecker& routines;
};

} // namespace rapid::sema
