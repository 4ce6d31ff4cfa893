//! Moving pictures: animated PNGs, which every browser shows and which lose nothing.

use crate::image::ImageError;

/// An animated 8-bit gray PNG that repeats for ever. Frames hold `width · height` bytes each, row by
/// row from the top; what cannot show animations shows the first.
///
/// # Errors
/// [`ImageError::Png`] for an empty image or no frames, [`ImageError::Length`] for frames of another
/// size.
pub fn gray(
    [width, height]: [u32; 2],
    frames: &[Vec<u8>],
    frames_per_second: u16,
) -> Result<Vec<u8>, ImageError> {
    let expected = width as usize * height as usize;
    if let Some(frame) = frames.iter().find(|frame| frame.len() != expected) {
        return Err(ImageError::Length { width, height, expected, got: frame.len() });
    }
    let encode = || -> Result<Vec<u8>, png::EncodingError> {
        let mut file = Vec::new();
        let mut encoder = png::Encoder::new(&mut file, width, height);
        encoder.set_color(png::ColorType::Grayscale);
        encoder.set_depth(png::BitDepth::Eight);
        encoder.set_compression(png::Compression::Balanced);
        encoder.set_animated(frames.len() as u32, 0)?;
        encoder.set_frame_delay(1, frames_per_second)?;
        let mut writer = encoder.write_header()?;
        for frame in frames {
            writer.write_image_data(frame)?;
        }
        writer.finish()?;
        Ok(file)
    };
    encode().map_err(|source| ImageError::Png { width, height, source })
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::io::Cursor;

    #[test]
    fn every_frame_comes_back() {
        let frames: Vec<Vec<u8>> = (0..5).map(|i| (0..12).map(|p| 20 * i + p).collect()).collect();
        let file = gray([4, 3], &frames, 20).unwrap();
        let mut reader = png::Decoder::new(Cursor::new(file)).read_info().unwrap();
        let control = *reader.info().animation_control().unwrap();
        assert_eq!((control.num_frames, control.num_plays), (5, 0));
        for frame in &frames {
            let mut bytes = vec![0; 12];
            reader.next_frame(&mut bytes).unwrap();
            assert_eq!(&bytes, frame);
            let timing = reader.info().frame_control().unwrap();
            assert_eq!((timing.delay_num, timing.delay_den), (1, 20));
        }
    }

    #[test]
    fn no_frames_and_wrong_sizes_are_refused() {
        assert!(matches!(gray([4, 3], &[], 20), Err(ImageError::Png { .. })));
        assert!(matches!(gray([4, 3], &[vec![0; 11]], 20), Err(ImageError::Length { got: 11, .. })));
    }
}
