//! Pages as templates: text with places for values by name.
//!
//! `{{name}}` stands for a value. Text between `{{?name}}` and `{{/name}}` stays only where the value is not empty.

/// Values by the names of their places.
pub type PlaceValues<'a> = [(&'a str, String)];

/// Fills a template. Values are not read for places.
///
/// # Panics
/// A template that names no value, or does not close what it opens.
pub fn filled(template: &str, values: &PlaceValues<'_>) -> String {
    let mut rest = template;
    let mut text = String::new();
    while let Some((before, after)) = rest.split_once("{{") {
        text.push_str(before);
        let (place, after) = split(after, "}}");
        rest = after;
        match place.strip_prefix('?') {
            None => text.push_str(value(values, place)),
            Some(name) => {
                let (inner, after) = split(after, &format!("{{{{/{name}}}}}"));
                rest = after;
                if !value(values, name).is_empty() {
                    text.push_str(&filled(inner, values));
                }
            }
        }
    }
    text + rest
}

fn split<'a>(text: &'a str, end: &str) -> (&'a str, &'a str) {
    let parts = text.split_once(end);
    parts.unwrap_or_else(|| panic!("a template without {end}"))
}

fn value<'a>(values: &'a PlaceValues<'_>, name: &str) -> &'a str {
    let found = values.iter().find(|(known, _)| *known == name);
    found.map_or_else(
        || panic!("a template that names {name}"),
        |(_, value)| value,
    )
}

#[cfg(test)]
mod tests {
    use super::filled;

    #[test]
    fn places_take_values_and_empty_ones_take_what_is_around_them() {
        let values = [
            ("a", "<{{b}}>".to_owned()),
            ("b", "2".into()),
            ("none", String::new()),
        ];
        let template = "{{a}} {{?b}}b is {{b}}{{?none}}, not {{a}}{{/none}}. {{/b}}{{none}}end";
        assert_eq!(filled(template, &values), "<{{b}}> b is 2. end");
        assert_eq!(filled("", &values), "");
    }

    #[test]
    #[should_panic(expected = "a template that names c")]
    fn a_place_without_a_value_is_told() {
        filled("{{c}}", &[]);
    }
}
