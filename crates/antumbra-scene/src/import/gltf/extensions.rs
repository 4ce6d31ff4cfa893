//! Which extensions a file may require: those that are read, and those that move no triangle.

use super::document::Document;
use crate::import::error::Problem;
use crate::import::notes::Notes;

/// Extensions that are read, for messages.
const READ: &str = "KHR_lights_punctual, KHR_materials_pbrSpecularGlossiness, \
    KHR_materials_transmission, KHR_mesh_quantization, KHR_meshopt_compression, KHR_node_visibility, \
    KHR_texture_transform, EXT_mesh_gpu_instancing, EXT_meshopt_compression, EXT_texture_webp, \
    CESIUM_RTC and MSFT_lod";

/// What `x` says in `KHR_x_something` where the extension is about looks, sound, light or behaviour.
const HARMLESS_KINDS: [&str; 13] = [
    "animation",
    "audio",
    "collision",
    "environment",
    "interactivity",
    "lights",
    "materials",
    "packing",
    "physics",
    "rigid",
    "techniques",
    "texture",
    "xmp",
];

/// Others that move no triangle: data beside the mesh, outlines, what users may touch.
const HARMLESS: [&str; 15] = [
    "AGI_stk_metadata",
    "CESIUM_primitive_outline",
    "CESIUM_tile_edges",
    "EXT_feature_metadata",
    "EXT_instance_features",
    "EXT_mesh_features",
    "EXT_mesh_manifold",
    "EXT_structural_metadata",
    "FB_geometry_metadata",
    "GRIFFEL_bim_data",
    "KHR_implicit_shapes",
    "KHR_node_hoverability",
    "KHR_node_selectability",
    "VRM",
    "VRMC_vrm",
];

const DRACO: &str = "KHR_draco_mesh_compression";
/// Decodes every compression that it knows, Draco among them, and writes plain buffers.
const DECODE: &str = "decode it with `gltf-transform copy in.glb out.glb`";

fn is_read(extension: &str) -> bool {
    extension.contains('_') && READ.split([',', ' ']).any(|name| name == extension)
}

/// Whether whatever the extension says leaves every triangle where it is.
fn is_harmless(extension: &str) -> bool {
    let mut words = extension.split('_').skip(1);
    HARMLESS.contains(&extension) || words.next().is_some_and(|kind| HARMLESS_KINDS.contains(&kind))
}

/// Refuses files that require what may move triangles and is not read; notes what else is not read.
pub(super) fn check(document: &Document, notes: &mut Notes) -> Result<(), Problem> {
    let mut harmless = Vec::new();
    for extension in &document.extensions_required {
        if is_harmless(extension) && !is_read(extension) {
            harmless.push(extension.as_str());
        } else if !is_read(extension) {
            return Err(unsupported("extensionsRequired".into(), extension));
        }
    }
    if !harmless.is_empty() {
        notes.say(format!(
            "extensionsRequired: {} {} not read; what such extensions say moves no triangle",
            harmless.join(", "),
            if harmless.len() == 1 { "is" } else { "are" }
        ));
    }
    for extension in &document.extensions_used {
        let known = is_read(extension) || is_harmless(extension) || extension == DRACO;
        if !known {
            notes.add(
                extension.as_str(),
                "this extension is not known and not read; triangles that it adds or moves are missing",
            );
        }
    }
    Ok(())
}

/// The refusal of an extension, with what turns the file into one that is taken.
pub(super) fn unsupported(element: String, extension: &str) -> Problem {
    let remedy = if extension == DRACO {
        DECODE.into()
    } else {
        "it may change what there is to see: write the file again without it, or strike it from \
         extensionsRequired if it does not"
            .into()
    };
    Problem::Extension { element, extension: extension.into(), remedy, allowed: READ }
}

/// Refuses a primitive whose vertices are there in compressed form only.
pub(super) fn check_primitive(
    extensions: &super::document::Extensions,
    has_data: bool,
    element: &str,
) -> Result<(), Problem> {
    if extensions.contains_key(DRACO) && !has_data {
        return Err(unsupported(format!("{element}.extensions"), DRACO));
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_moves_triangles_is_not_harmless() {
        for name in
            ["KHR_materials_variants", "EXT_lights_image_based", "KHR_texture_basisu", "KHR_xmp_json_ld"]
        {
            assert!(is_harmless(name), "{name}");
        }
        for name in [
            "KHR_draco_mesh_compression",
            "KHR_mesh_quantization",
            "FAKE_thing",
            "EXT_implicit_ellipsoid_region",
        ] {
            assert!(!is_harmless(name), "{name}");
        }
        assert!(is_read("MSFT_lod") && is_read("KHR_lights_punctual") && !is_read("and"));
    }
}
