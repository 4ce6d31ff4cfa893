//! Against bytes that meshoptimizer 1.3 encoded, and damaged copies of them.

#![allow(clippy::unwrap_used, reason = "tests fail by panicking")]

use super::*;

const VERTICES_0: &str = "oAcAWl5iZmpucnZ6foKGio6S/wAAAJaanqIFKq6urgQEBLoAAAAEBwBPT09PT09PT09PT09PT0//AAAAT09PTwEAAQAQAAAHAD8/Pz9/f/////+AgEBAQP8AAABAICAgBRAB+ACEfIAAAAAABwDCwsLCwsLCwsLCwsLCwsL/AAAAwsLCwgUmZmZmZgAAAAUquq6rBwcHqgAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAD//wAAAMAHAAAA";
const VERTICES_1: &str = "obc6XgBaXmJmam5ydnp+goaKjpKWmp6iBSqqqqqqAAAAAE9PT09PT09PT09PT09PT09PT08APz8/P39//wAAAICAQEBAQCAgIAEAB4N9AQDCwsLCwsLCwsLCwsLCwsLCwsLCBSZmZmZmAAAABSq6rqsHBweqAAAAAAAAAAAAAAAAAAD//wAAAMAHAAAAAQEA";
const TRIANGLES: &str = "4f4eEA4QDhAOzh4WDhUOFA7OHhQOFA4UDv8v/g8K7+IN2LcI1bcIAAB2h1ZneKmGZYlomAFpAAA=";
const SEQUENCE: &str = "0QAEEA4UAg4EEA4UAg4EEA4UAg4EEA4UAgoEEA4UAg4EEA4UAg4EEA4UAg4EEA4UAgoEEA4UAg4EEA4UAg4EEA4UAg4EEA4UApEcOrHvEACv7xAFCgQEAAAAAA==";

/// Twenty vertices of two 16-bit numbers, a float and four bytes.
fn vertices() -> Vec<u8> {
    let vertex = |i: u16| {
        let float = 0.25 * f32::from(i) - 2.0;
        let words = [300 * i + i * i, 65535 - 40 * i].map(u16::to_le_bytes).concat();
        [words, float.to_le_bytes().to_vec(), vec![7, ((97 * i) & 255) as u8, (i & 1) as u8, (i % 5) as u8]]
            .concat()
    };
    (0..20).flat_map(vertex).collect()
}

/// A grid of 4 by 3 squares, then triangles far from it.
fn corners() -> Vec<u32> {
    let square = |v: u32| [v, v + 1, v + 5, v + 1, v + 6, v + 5];
    let grid = (0..3).flat_map(|y| (0..4).map(move |x| 5 * y + x)).flat_map(square);
    grid.chain([900, 3, 70000, 3, 900, 901, 0, 1, 2]).collect()
}

fn base64(text: &str) -> Vec<u8> {
    let uri = format!("data:;base64,{text}");
    container::resource(&uri, "test", None).unwrap()
}

#[test]
fn vertices_of_both_versions() {
    for text in [VERTICES_0, VERTICES_1] {
        assert_eq!(vertex::decode(&base64(text), 20, 12).unwrap(), vertices());
    }
}

#[test]
fn triangles_keep_their_winding() {
    let turned = |t: &[u32]| (0..3).map(|k| [t[k], t[(k + 1) % 3], t[(k + 2) % 3]]).min().unwrap();
    let found = index::triangles(&base64(TRIANGLES), 81).unwrap();
    let [found, wanted] = [found, corners()].map(|all| all.chunks(3).map(turned).collect::<Vec<_>>());
    assert_eq!(found, wanted);
    assert_eq!(index::sequence(&base64(SEQUENCE), 81).unwrap(), corners());
}

#[test]
fn filters() {
    type Case = (fn(&mut [u8]), &'static [u8], &'static [u8]);
    let cases: [Case; 6] = [
        (filter::octahedral_8, &[92, 83, 127, 0, 129, 0, 127, 0], &[76, 60, 174, 0, 129, 0, 0, 0]),
        (
            filter::octahedral_16,
            &[196, 5, 53, 5, 255, 7, 0, 0, 0, 0, 206, 1, 255, 7, 0, 0],
            &[202, 76, 105, 61, 13, 174, 0, 0, 0, 0, 209, 35, 226, 122, 0, 0],
        ),
        (
            filter::quaternion,
            &[160, 22, 96, 233, 134, 4, 255, 31, 109, 242, 147, 13, 134, 4, 253, 31],
            &[0, 64, 0, 192, 204, 12, 153, 89, 204, 12, 51, 115, 154, 217, 102, 38],
        ),
        (
            filter::exponential,
            &[24, 0, 0, 252, 124, 193, 255, 252, 197, 32, 0, 233, 0, 0, 0, 233],
            &[0, 0, 192, 63, 0, 16, 122, 196, 0, 20, 131, 58, 0, 0, 0, 0],
        ),
        (filter::color_8, &[144, 95, 241, 255, 147, 218, 83, 204], &[254, 129, 64, 255, 26, 230, 102, 152]),
        (
            filter::color_16,
            &[0, 36, 255, 23, 1, 252, 255, 63, 204, 36, 103, 246, 204, 20, 51, 51],
            &[251, 255, 6, 128, 1, 64, 255, 255, 156, 25, 99, 230, 101, 102, 158, 153],
        ),
    ];
    for (i, (filter, coded, wanted)) in cases.into_iter().enumerate() {
        let mut bytes = coded.to_vec();
        filter(&mut bytes);
        assert_eq!(bytes, wanted, "filter {i}");
    }
}

/// Every byte changed in several ways, and every shorter file: an error or other numbers, no panic.
#[test]
fn damage_never_panics() {
    let mut refused = 0;
    for text in [VERTICES_0, VERTICES_1, TRIANGLES, SEQUENCE] {
        let whole = base64(text);
        let mut attempt = |bytes: &[u8]| {
            let results = [
                vertex::decode(bytes, 20, 12).map(|_| ()),
                index::triangles(bytes, 81).map(|_| ()),
                index::sequence(bytes, 81).map(|_| ()),
            ];
            refused += results.iter().filter(|r| r.is_err()).count();
        };
        for at in 0..whole.len() {
            attempt(&whole[..at]);
            for change in [1, 16, 128, 255] {
                let mut bytes = whole.clone();
                bytes[at] ^= change;
                attempt(&bytes);
            }
        }
    }
    assert!(refused > 3000, "{refused}");
}

#[test]
fn what_is_no_stream_is_refused_with_a_reason() {
    assert_eq!(vertex::decode(&[], 1, 4), Err(SHORT));
    assert_eq!(vertex::decode(&[0xa2; 60], 1, 4), Err(VERSION));
    assert_eq!(vertex::decode(&[0xa0; 20], 1, 4), Err(SHORT));
    let mut long = base64(VERTICES_1);
    long.insert(1, 0);
    assert!(vertex::decode(&long, 20, 12).is_err());
    assert_eq!(index::triangles(&[0xe1; 4], 300), Err(SHORT));
    // A count beyond what the bytes can hold allocates nothing.
    assert_eq!(vertex::decode(&base64(VERTICES_0), usize::MAX / 256, 256), Err(SHORT));
}
