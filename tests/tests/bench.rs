//! `glassbrick bench`, as users run it, and the plain ray caster that it compares with.

mod comparing;
mod counts;
mod plain_caster;
mod refusals;
mod results;
