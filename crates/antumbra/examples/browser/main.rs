//! A page with shadows, by WebGPU: boxes on a floor, drawn once into a canvas. `index.html` beside this file says
//! how it is built and served.

#[cfg(target_arch = "wasm32")]
#[path = "../common/mod.rs"]
mod common;
#[cfg(target_arch = "wasm32")]
mod page;

#[cfg(target_arch = "wasm32")]
fn main() {
    wasm_bindgen_futures::spawn_local(async {
        if let Err(error) = page::run().await {
            page::say(&error.to_string());
        }
    });
}

#[cfg(not(target_arch = "wasm32"))]
fn main() {
    println!("this is a page: see crates/antumbra/examples/browser/index.html");
}
