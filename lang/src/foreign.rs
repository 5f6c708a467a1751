//! Words of other languages, and how ours says what they say.

/// What to write instead of a word that another language would have here.
pub fn help(word: &str) -> Option<&'static str> {
    Some(match word {
        "null" | "nil" | "None" | "nullptr" | "undefined" => "what is absent is `none`",
        "True" | "TRUE" => "write `true`",
        "False" | "FALSE" => "write `false`",
        "break" => "a loop ends by its condition: write `while CONDITION { … }`, or `finish` to leave the behavior",
        "continue" => "put what else the loop does into an `if`: it then goes round by itself",
        "return" => "a function gives its last expression, and a behavior ends with `finish`",
        "sleep" | "pause" | "delay" => "write `wait for 3 s`",
        "print" | "println" | "printf" | "echo" => "write `log \"…\"`; a value stands in it between `{` and `}`",
        "elif" | "elsif" | "elseif" => "write `else if`",
        "def" | "func" | "function" => "a function is `fn NAME(x: TYPE) -> TYPE { … }`",
        "class" | "struct" => "a group of values is `record NAME { field: TYPE }`",
        "import" | "include" | "from" => "write `use MODULE` at the top of the file",
        "use" => "`use` stands at the top of the file, at the left margin",
        "switch" | "case" => "write `match VALUE { NAME { … } else { … } }`",
        "repeat" => "write `for n in 1..3 { … }`",
        _ => return None,
    })
}
