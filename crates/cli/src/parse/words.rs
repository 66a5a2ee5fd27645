use glassbrick::{Background, LevelChoice, StoredType};

/// Reads `#rrggbb` or `transparent`.
pub fn background(text: &str) -> Result<Background, String> {
    Background::parse(text).ok_or_else(|| "a colour such as #203040 is wanted, or transparent".to_owned())
}

/// Reads `auto` or the number of a level.
pub fn level(text: &str) -> Result<LevelChoice, String> {
    if text == "auto" {
        return Ok(LevelChoice::Auto);
    }
    text.parse()
        .map(LevelChoice::Exact)
        .map_err(|_| "auto or the number of a level is wanted, from 0".to_owned())
}

/// Reads the name of a stored type.
pub fn dtype(text: &str) -> Result<StoredType, String> {
    StoredType::from_name(text).ok_or_else(|| {
        let names: Vec<_> = StoredType::ALL.iter().map(|stored_type| stored_type.name()).collect();
        format!("one of {} is wanted", names.join(", "))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn colours_levels_and_types_are_read_from_their_words() {
        assert_eq!(background("#ff8000"), Ok(Background::Color([255, 128, 0])));
        assert_eq!(background("transparent"), Ok(Background::Transparent));
        assert_eq!((level("auto"), level("2")), (Ok(LevelChoice::Auto), Ok(LevelChoice::Exact(2))));
        assert_eq!(dtype("f32"), Ok(StoredType::F32));
    }

    #[test]
    fn other_words_are_told_what_is_wanted() {
        assert!(background("red").expect_err("no colour").contains("#203040"));
        assert!(level("-1").expect_err("no level").contains("auto"));
        assert!(dtype("int16").expect_err("no type").contains("u8, i8, u16, i16, u32, i32, f32, f64"));
    }
}
