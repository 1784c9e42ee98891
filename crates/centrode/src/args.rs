use std::path::PathBuf;

use centrode::mechanism::design::Design;
use clap::builder::PossibleValuesParser;
use clap::{Args, Parser, Subcommand};

/// Design, prove and export non-circular gears.
#[derive(Debug, Parser)]
#[command(
    name = "centrode",
    version,
    after_help = "Exit status: 0 good; 1 a finding of severity error; 2 no mechanism, a bad design file or bad usage."
)]
pub(crate) struct Arguments {
    #[command(subcommand)]
    pub(crate) command: Command,
}

#[derive(Debug, Subcommand)]
pub(crate) enum Command {
    /// Print a commented design file to edit
    New(New),
    /// Resolve a design and report its figures and findings
    Check(Check),
    /// Print the JSON schema of the design file
    Schema,
    /// Print a completion script for a shell
    Completions(Completions),
    /// Print the man page of the program or of a command
    Man(Man),
}

#[derive(Debug, Args)]
#[command(after_help = "Example: centrode new gear-pair > pair.toml")]
pub(crate) struct New {
    /// Family of mechanism
    #[arg(value_parser = PossibleValuesParser::new(Design::FAMILIES))]
    pub(crate) family: String,
}

#[derive(Debug, Args)]
#[command(
    after_help = "Exit status: 0 good; 1 a finding of severity error; 2 no mechanism or a bad design file."
)]
pub(crate) struct Check {
    /// Design file, or - for standard input
    pub(crate) design: PathBuf,
    /// Print the report as JSON
    #[arg(long)]
    pub(crate) json: bool,
}

#[derive(Debug, Args)]
pub(crate) struct Completions {
    /// Shell that reads the script
    #[arg(value_enum)]
    pub(crate) shell: clap_complete::Shell,
}

#[derive(Debug, Args)]
pub(crate) struct Man {
    /// Command to describe; left out, the program
    pub(crate) command: Option<String>,
}
