//! The codes of findings: all there are, so that none is misspelt and each can be explained.
//!
//! A new one is written here, has a page in `docs/explain`, and a bad script in `tests/diagnostics` that shows it.

use std::fmt;

/// Declares the codes, group by group, in the order of their names.
macro_rules! codes {
    ($($group:ident { $($variant:ident = $name:literal,)* })*) => {
        /// What kind of mistake a finding tells of. It is printed as `group::name`, which never changes its meaning.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
        #[expect(missing_docs, reason = "each has a page that says what it means")]
        pub enum Code {
            $($($variant,)*)*
        }

        impl Code {
            /// All of them, in the order of their names.
            pub const ALL: &[Code] = &[$($(Code::$variant,)*)*];

            /// As it is printed: `units::unknown`.
            pub const fn name(self) -> &'static str {
                match self {
                    $($(Code::$variant => concat!(stringify!($group), "::", $name),)*)*
                }
            }

            /// What it means, why the language insists, and how such a mistake is mended: Markdown, its title first.
            pub const fn page(self) -> &'static str {
                match self {
                    $($(Code::$variant =>
                        include_str!(concat!("../../../docs/explain/", stringify!($group), "/", $name, ".md")),)*)*
                }
            }
        }
    };
}

codes! {
    absent {
        AbsentElse = "else",
        AbsentLet = "let",
        AbsentUsed = "used",
    }
    areas {
        AreasCrossed = "crossed",
        AreasFile = "file",
        AreasGoal = "goal",
        AreasLarge = "large",
        AreasPole = "pole",
        AreasSmall = "small",
        AreasSwapped = "swapped",
    }
    args {
        ArgsLabel = "label",
        ArgsMany = "many",
        ArgsMissing = "missing",
        ArgsTwice = "twice",
    }
    channels {
        ChannelsAmend = "amend",
        ChannelsEnds = "ends",
        ChannelsOther = "other",
        ChannelsTwice = "twice",
        ChannelsUnknown = "unknown",
        ChannelsUnset = "unset",
    }
    flow {
        FlowEndless = "endless",
        FlowFinish = "finish",
        FlowRecursion = "recursion",
        FlowResult = "result",
        FlowUnreachable = "unreachable",
        FlowUnused = "unused",
        FlowValue = "value",
    }
    functions {
        FunctionsPure = "pure",
    }
    imports {
        ImportsCycle = "cycle",
        ImportsMany = "many",
        ImportsTwice = "twice",
        ImportsUnknown = "unknown",
    }
    layout {
        LayoutBrace = "brace",
        LayoutComment = "comment",
        LayoutLine = "line",
    }
    limits {
        LimitsCalls = "calls",
        LimitsCapacities = "capacities",
        LimitsConstants = "constants",
        LimitsInstructions = "instructions",
        LimitsMemory = "memory",
        LimitsMissions = "missions",
        LimitsRange = "range",
        LimitsRecord = "record",
        LimitsRules = "rules",
        LimitsSetpoint = "setpoint",
        LimitsSignal = "signal",
        LimitsSteps = "steps",
    }
    missions {
        MissionsArea = "area",
        MissionsDefault = "default",
        MissionsEndless = "endless",
        MissionsLimit = "limit",
        MissionsLimits = "limits",
        MissionsOrigin = "origin",
        MissionsRecord = "record",
        MissionsRecovery = "recovery",
        MissionsRequires = "requires",
        MissionsTwice = "twice",
        MissionsUnread = "unread",
        MissionsUnrequired = "unrequired",
        MissionsWithin = "within",
    }
    names {
        NamesAssign = "assign",
        NamesCall = "call",
        NamesInput = "input",
        NamesMember = "member",
        NamesModule = "module",
        NamesRecursive = "recursive",
        NamesShadowed = "shadowed",
        NamesTwice = "twice",
        NamesUnknown = "unknown",
        NamesUnused = "unused",
        NamesValue = "value",
    }
    prompt {
        PromptMisplaced = "misplaced",
        PromptValue = "value",
    }
    ranges {
        RangesConstant = "constant",
        RangesDuration = "duration",
        RangesEmpty = "empty",
        RangesHeading = "heading",
        RangesNegative = "negative",
        RangesOpen = "open",
        RangesOutside = "outside",
        RangesRatio = "ratio",
        RangesSide = "side",
        RangesStep = "step",
        RangesUnproved = "unproved",
        RangesZero = "zero",
    }
    rules {
        RulesBack = "back",
        RulesDerived = "derived",
        RulesDone = "done",
        RulesEnding = "ending",
        RulesForever = "forever",
        RulesLivelock = "livelock",
        RulesOverlap = "overlap",
        RulesParams = "params",
        RulesResult = "result",
        RulesShadowed = "shadowed",
        RulesStart = "start",
        RulesUnknown = "unknown",
        RulesUnreachable = "unreachable",
    }
    scenarios {
        ScenariosClause = "clause",
        ScenariosDerived = "derived",
        ScenariosOutside = "outside",
        ScenariosTwice = "twice",
        ScenariosUnknown = "unknown",
        ScenariosWorld = "world",
    }
    set {
        SetForm = "form",
        SetGiven = "given",
        SetUnknown = "unknown",
        SetUnreached = "unreached",
    }
    syntax {
        SyntaxBracket = "bracket",
        SyntaxChain = "chain",
        SyntaxClause = "clause",
        SyntaxComment = "comment",
        SyntaxDeceptive = "deceptive",
        SyntaxExpected = "expected",
        SyntaxItem = "item",
        SyntaxMisplaced = "misplaced",
        SyntaxModifier = "modifier",
        SyntaxNesting = "nesting",
        SyntaxReserved = "reserved",
        SyntaxSetpoint = "setpoint",
        SyntaxText = "text",
    }
    tests {
        TestsBehavior = "behavior",
        TestsMission = "mission",
        TestsName = "name",
        TestsNothing = "nothing",
        TestsReport = "report",
        TestsRun = "run",
        TestsSeeds = "seeds",
        TestsShare = "share",
        TestsTruth = "truth",
    }
    time {
        TimeAbsence = "absence",
        TimeAmbiguous = "ambiguous",
        TimeAsk = "ask",
        TimeBody = "body",
        TimeCall = "call",
        TimeControl = "control",
        TimeHere = "here",
        TimeInstant = "instant",
        TimeInstantLoop = "instant_loop",
        TimeModifier = "modifier",
        TimeMomentary = "momentary",
        TimeRhythm = "rhythm",
        TimeSample = "sample",
        TimeUnread = "unread",
        TimeVar = "var",
        TimeWith = "with",
    }
    types {
        TypesBehavior = "behavior",
        TypesCapacity = "capacity",
        TypesComparison = "comparison",
        TypesCondition = "condition",
        TypesDate = "date",
        TypesDifference = "difference",
        TypesEmpty = "empty",
        TypesFor = "for",
        TypesHits = "hits",
        TypesIfLet = "if_let",
        TypesIfValue = "if_value",
        TypesIndex = "index",
        TypesKey = "key",
        TypesList = "list",
        TypesMatch = "match",
        TypesMemory = "memory",
        TypesMismatch = "mismatch",
        TypesName = "name",
        TypesNone = "none",
        TypesNumber = "number",
        TypesOrder = "order",
        TypesOverlay = "overlay",
        TypesPosition = "position",
        TypesPower = "power",
        TypesProduct = "product",
        TypesQuantity = "quantity",
        TypesQuotient = "quotient",
        TypesRecursive = "recursive",
        TypesResult = "result",
        TypesSign = "sign",
        TypesStatement = "statement",
        TypesSum = "sum",
        TypesText = "text",
        TypesToward = "toward",
        TypesUnknown = "unknown",
        TypesWalked = "walked",
    }
    units {
        UnitsDeclaration = "declaration",
        UnitsUnknown = "unknown",
    }
}

impl Code {
    /// The code that is printed so.
    pub fn named(name: &str) -> Option<Code> {
        Code::ALL.iter().copied().find(|code| code.name() == name)
    }

    /// What it means, in one line.
    pub fn title(self) -> &'static str {
        self.page().lines().next().unwrap_or_default().trim_start_matches("# ")
    }

    /// What stands before its `::`: the codes of a group are of one matter.
    pub fn group(self) -> &'static str {
        self.name().split_once("::").map_or("", |(group, _)| group)
    }
}

impl fmt::Display for Code {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}
