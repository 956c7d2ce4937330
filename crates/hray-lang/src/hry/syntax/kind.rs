//! The kinds of tokens and nodes of the syntax tree.

/// Lists the kinds once: the enum, and the table from numbers back to kinds.
macro_rules! kinds {
    ($($(#[$doc:meta])* $kind:ident,)+) => {
        /// A kind of token or node.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
        #[repr(u16)]
        pub enum SyntaxKind { $($(#[$doc])* $kind,)+ }

        /// Every kind, in the order of their numbers.
        const ALL: &[SyntaxKind] = &[$(SyntaxKind::$kind,)+];
    };
}

kinds! {
    /// White space, and characters that look like it.
    Whitespace,
    /// `-- ...`
    Comment,
    /// `{- ... -}`
    BlockComment,
    /// Characters that belong to nothing; an error was reported.
    Unknown,

    /// A number, its suffix included.
    Number,
    /// `#rgb`, `#rrggbb`
    Color,
    /// `"..."`
    Text,
    /// A name with a lower-case initial.
    Name,
    /// A name with an upper-case initial.
    TypeName,

    /// `let`
    LetKeyword,
    /// `in`
    InKeyword,
    /// `if`
    IfKeyword,
    /// `then`
    ThenKeyword,
    /// `else`
    ElseKeyword,
    /// `match`
    MatchKeyword,
    /// `and`
    AndKeyword,
    /// `or`
    OrKeyword,
    /// `not`
    NotKeyword,
    /// `true`
    TrueKeyword,
    /// `false`
    FalseKeyword,
    /// `import`
    ImportKeyword,
    /// `as`
    AsKeyword,

    /// `(`
    OpenParen,
    /// `)`
    CloseParen,
    /// `[`
    OpenBracket,
    /// `]`
    CloseBracket,
    /// `{`
    OpenBrace,
    /// `}`
    CloseBrace,

    /// `|>`
    Pipe,
    /// `>>`
    Compose,
    /// `++`
    Append,
    /// `+`
    Plus,
    /// `-`
    Minus,
    /// `*`
    Star,
    /// `/`
    Slash,
    /// `%`
    Percent,
    /// `^`
    Caret,
    /// `==`
    Equal,
    /// `!=`
    NotEqual,
    /// `<`
    Less,
    /// `<=`
    LessEqual,
    /// `>`
    Greater,
    /// `>=`
    GreaterEqual,
    /// `=`
    Define,
    /// `->`
    Arrow,
    /// `<-`
    From,
    /// `|`
    Bar,
    /// `\`
    Backslash,
    /// `.`
    Dot,
    /// `..`
    DotDot,
    /// `,`
    Comma,
    /// `:`
    Colon,
    /// `_`
    Underscore,
    /// `;`, which means nothing; the parser knows what it was meant for.
    Semicolon,
    /// `!`, which means nothing by itself; the parser knows what it was meant for.
    Bang,
    /// The end of what is being read: of the file, or of a binding by its layout. Never in a tree.
    End,

    /// A file.
    File,
    /// `import "palette.hry" (gold, ink)`
    Import,
    /// `name : Type`
    Annotation,
    /// `name parameters = body`
    Definition,

    /// A number, colour, text or truth value.
    Literal,
    /// A name.
    NameExpr,
    /// `(expression)`
    ParenExpr,
    /// `(expression : type)`
    AnnotatedExpr,
    /// `(x, y)`, `(x, y, z)`
    VectorExpr,
    /// `[a, b]`
    ListExpr,
    /// `[first .. last]`, `[first, second .. last]`
    RangeExpr,
    /// `[body | qualifiers]`
    ComprehensionExpr,
    /// `{ a = 1, b }`
    RecordExpr,
    /// `{ record | a = 1 }`
    UpdateExpr,
    /// `record.field`
    FieldExpr,
    /// `function argument`
    ApplyExpr,
    /// `-a`, `not a`
    UnaryExpr,
    /// `a + b`
    BinaryExpr,
    /// `if a then b else c`
    IfExpr,
    /// `let bindings in body`
    LetExpr,
    /// `\parameters -> body`
    LambdaExpr,
    /// `match subject { arms }`
    MatchExpr,
    /// What could not be read where an expression belongs.
    ErrorExpr,

    /// `name = value`, `name` in a record.
    FieldValue,
    /// `pattern -> body` in a match.
    MatchArm,
    /// `pattern <- list` in a comprehension.
    Generator,
    /// A condition in a comprehension.
    Guard,
    /// `let` bindings in a comprehension.
    LetQualifier,

    /// A name that is bound.
    NamePattern,
    /// `_`
    WildcardPattern,
    /// A number, text or truth value.
    LiteralPattern,
    /// `(pattern)`
    ParenPattern,
    /// `(pattern, pattern)`
    VectorPattern,
    /// `[pattern, ..rest]`
    ListPattern,
    /// `..rest`
    RestPattern,
    /// `{ name = pattern }`
    RecordPattern,
    /// `name = pattern`, `name` in a record pattern.
    FieldPattern,
    /// What could not be read where a pattern belongs.
    ErrorPattern,

    /// The name of a type, or a variable.
    NameType,
    /// `[a]`
    ListType,
    /// `a -> b`
    FunctionType,
    /// `{ a : Number }`
    RecordType,
    /// `a : Number` in a record type.
    FieldType,
    /// `(type)`
    ParenType,
    /// What could not be read where a type belongs.
    ErrorType,
}

impl SyntaxKind {
    /// Whether it is white space, a comment, or characters that belong to nothing.
    #[must_use]
    pub const fn is_trivia(self) -> bool {
        matches!(self, Self::Whitespace | Self::Comment | Self::BlockComment | Self::Unknown)
    }

    /// Whether it is a node that stands for an expression.
    #[must_use]
    pub const fn is_expr(self) -> bool {
        self as u16 >= Self::Literal as u16 && self as u16 <= Self::ErrorExpr as u16
    }

    /// Whether it is a node that stands for a pattern.
    #[must_use]
    pub const fn is_pattern(self) -> bool {
        self as u16 >= Self::NamePattern as u16 && self as u16 <= Self::ErrorPattern as u16
    }

    /// Whether it is a node that stands for a type.
    #[must_use]
    pub const fn is_type(self) -> bool {
        self as u16 >= Self::NameType as u16 && self as u16 <= Self::ErrorType as u16
    }

    /// Whether it is a word of the language.
    #[must_use]
    pub const fn is_keyword(self) -> bool {
        self as u16 >= Self::LetKeyword as u16 && self as u16 <= Self::AsKeyword as u16
    }

    /// The word of the language that a name is, where it is one.
    #[must_use]
    pub fn keyword(name: &str) -> Option<Self> {
        Some(match name {
            "let" => Self::LetKeyword,
            "in" => Self::InKeyword,
            "if" => Self::IfKeyword,
            "then" => Self::ThenKeyword,
            "else" => Self::ElseKeyword,
            "match" => Self::MatchKeyword,
            "and" => Self::AndKeyword,
            "or" => Self::OrKeyword,
            "not" => Self::NotKeyword,
            "true" => Self::TrueKeyword,
            "false" => Self::FalseKeyword,
            "import" => Self::ImportKeyword,
            "as" => Self::AsKeyword,
            _ => return None,
        })
    }

    /// Whether it is an opening bracket.
    pub(crate) const fn is_open(self) -> bool {
        matches!(self, Self::OpenParen | Self::OpenBracket | Self::OpenBrace)
    }

    /// Whether it is a closing bracket.
    pub(crate) const fn is_close(self) -> bool {
        matches!(self, Self::CloseParen | Self::CloseBracket | Self::CloseBrace)
    }

    /// The closing bracket of an opening one.
    pub(crate) const fn closing(self) -> Self {
        match self {
            Self::OpenBracket => Self::CloseBracket,
            Self::OpenBrace => Self::CloseBrace,
            _ => Self::CloseParen,
        }
    }

    /// How brackets and the punctuation that other characters are mistaken for are written.
    pub(crate) const fn spelling(self) -> &'static str {
        match self {
            Self::OpenParen => "(",
            Self::CloseParen => ")",
            Self::OpenBracket => "[",
            Self::CloseBracket => "]",
            Self::OpenBrace => "{",
            Self::CloseBrace => "}",
            Self::Define => "=",
            Self::Arrow => "->",
            Self::From => "<-",
            Self::Bar => "|",
            Self::Comma => ",",
            Self::Colon => ":",
            Self::InKeyword => "in",
            Self::ThenKeyword => "then",
            Self::ElseKeyword => "else",
            Self::AndKeyword => "and",
            Self::OrKeyword => "or",
            Self::NotKeyword => "not",
            Self::Equal => "==",
            Self::NotEqual => "!=",
            Self::LessEqual => "<=",
            Self::GreaterEqual => ">=",
            Self::Caret => "^",
            Self::Minus => "-",
            Self::Star => "*",
            Self::Slash => "/",
            Self::DotDot => "..",
            Self::Compose => ">>",
            _ => "",
        }
    }
}

/// The language of the tree, for the `rowan` crate.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Hry {}

impl rowan::Language for Hry {
    type Kind = SyntaxKind;

    fn kind_from_raw(raw: rowan::SyntaxKind) -> SyntaxKind {
        ALL.get(usize::from(raw.0)).copied().unwrap_or(SyntaxKind::Unknown)
    }

    fn kind_to_raw(kind: SyntaxKind) -> rowan::SyntaxKind {
        rowan::SyntaxKind(kind as u16)
    }
}

/// A node of the lossless tree.
pub type SyntaxNode = rowan::SyntaxNode<Hry>;
/// A token of the lossless tree.
pub type SyntaxToken = rowan::SyntaxToken<Hry>;
/// A node or a token of the lossless tree.
pub type SyntaxElement = rowan::SyntaxElement<Hry>;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_table_has_every_kind_at_its_number() {
        for (number, kind) in ALL.iter().enumerate() {
            assert_eq!(*kind as usize, number);
        }
        assert_eq!(ALL.last(), Some(&SyntaxKind::ErrorType));
    }
}
