//! The Explorer: the closed model in a web browser, on this machine only.

use std::io;
use std::net::{Ipv4Addr, SocketAddr, TcpListener};

use stateright::Model;

use crate::closed::Closed;

/// Serves the Explorer on loopback, until the process ends.
///
/// `ready` gets the address just before it is served. With port 0 the system chooses one that is free.
///
/// # Errors
///
/// If the port cannot be had. It is tried out first, because the server behind the Explorer panics if it cannot have it:
/// a program that takes the port between the two still makes it panic.
pub fn serve(model: Closed, port: u16, ready: impl FnOnce(SocketAddr)) -> io::Result<()> {
    let address = TcpListener::bind((Ipv4Addr::LOCALHOST, port))?.local_addr()?;
    ready(address);
    let _checker = model.checker().serve(address);
    Ok(())
}

#[cfg(test)]
mod tests {
    use std::io::ErrorKind;
    use std::net::{Ipv4Addr, TcpListener};

    use adsdv_spec::Machine;

    use super::{Closed, serve};

    #[test]
    fn a_port_that_is_taken_is_an_error() {
        let taken = TcpListener::bind((Ipv4Addr::LOCALHOST, 0)).expect("a free port");
        let port = taken.local_addr().expect("its number").port();
        let served = serve(Closed::explorer(Machine::REFERENCE), port, |_| panic!("nothing is served"));
        assert_eq!(served.expect_err("the port is taken").kind(), ErrorKind::AddrInUse);
    }
}
