//! The macros of Kani, as far as this project uses them; see `kani.rs`.

use proc_macro::{TokenStream, TokenTree};

/// An implementation for the type that is derived upon, which has no parameters.
#[proc_macro_derive(Arbitrary)]
pub fn arbitrary(item: TokenStream) -> TokenStream {
    let mut tokens = item.into_iter().skip_while(|token| {
        !matches!(token, TokenTree::Ident(word) if ["struct", "enum"].contains(&word.to_string().as_str()))
    });
    let name = tokens.nth(1).expect("a struct or an enum has a name");
    format!("impl kani::Arbitrary for {name} {{ fn any() -> Self {{ panic!(\"only a signature\") }} }}").parse().expect("an impl")
}

#[proc_macro_attribute]
pub fn proof(_: TokenStream, item: TokenStream) -> TokenStream {
    item
}

#[proc_macro_attribute]
pub fn unwind(_: TokenStream, item: TokenStream) -> TokenStream {
    item
}

#[proc_macro_attribute]
pub fn solver(_: TokenStream, item: TokenStream) -> TokenStream {
    item
}
