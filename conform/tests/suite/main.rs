//! The suite: it kills every mutation, has a test for all that it should, and is read as it is written.

mod complete;
mod lines;
mod outputs;
mod requirements;
mod written;

use adsdv_conform::suite::{self, Test};
use adsdv_spec::Edition;

fn tests() -> Vec<Test> {
    suite::generate(Edition::DEFAULT)
}
