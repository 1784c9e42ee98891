//! New tables and values in the text, written like the shipped designs.

use toml_edit::{DocumentMut, Item, Table};

use super::Refusal;

/// The number with six significant digits.
pub(super) fn digits(value: f64) -> f64 {
    format!("{value:.5e}").parse().unwrap_or(value) + 0.0
}

/// Adds a table to the design; `body` has its keys, one per line.
pub(super) fn put(
    document: &mut DocumentMut,
    table: &str,
    name: &str,
    body: &str,
) -> Result<(), Box<Refusal>> {
    let wrong = |_| Box::new(Refusal::because(format!("{name} cannot be a name")));
    let text = format!("[{table}.{name}]\n{body}");
    let mut made: DocumentMut = text.parse().map_err(wrong)?;
    let Some(item) = made
        .get_mut(table)
        .and_then(|all| all.as_table_mut()?.remove(name))
    else {
        return Err(Box::new(Refusal::because(format!(
            "{name} cannot be a name"
        ))));
    };
    insert(document, table, name, item)
}

/// Adds a table to the design, after the others of its kind.
pub(super) fn insert(
    document: &mut DocumentMut,
    table: &str,
    name: &str,
    mut item: Item,
) -> Result<(), Box<Refusal>> {
    apart(&mut item);
    let all = document.entry(table).or_insert_with(|| {
        let mut all = Table::new();
        all.set_implicit(true);
        Item::Table(all)
    });
    if all.is_inline_table() {
        // A table in one line cannot hold a table with a header.
        let inline = std::mem::take(all).into_table();
        *all = inline.map_or_else(|same| same, Item::Table);
    }
    match all.as_table_mut() {
        Some(all) => drop(all.insert(name, item)),
        None => {
            let why = format!("{table} is not a table");
            return Err(Box::new(Refusal::because(why)));
        }
    }
    Ok(())
}

/// Puts an empty line before a table, which follows the tables that are there.
fn apart(item: &mut Item) {
    let Some(table) = item.as_table_mut() else {
        return;
    };
    table.set_position(None);
    table.decor_mut().set_prefix("\n");
    for (_, inner) in table.iter_mut() {
        if inner.is_table() {
            apart(inner);
        }
    }
}

/// Adds a point to a body.
pub(super) fn put_point(
    document: &mut DocumentMut,
    body: &str,
    name: &str,
    at: [f64; 2],
) -> Result<(), Box<Refusal>> {
    put_in(
        document,
        body,
        "points",
        name,
        &format!("[{}, {}]", at[0], at[1]),
    )
}

/// Adds a point or a corner to a body, whose table may not be there.
pub(super) fn put_in(
    document: &mut DocumentMut,
    body: &str,
    kind: &str,
    name: &str,
    value: &str,
) -> Result<(), Box<Refusal>> {
    let wrong = || {
        Box::new(Refusal::because(format!(
            "{body} cannot have the point {name}"
        )))
    };
    let path: Vec<&str> = match body {
        "frame" => vec!["frame"],
        _ => vec!["bodies", body],
    };
    let own = path
        .iter()
        .try_fold(document.as_item(), |item, key| item.get(*key));
    let value: toml_edit::Value = value.parse().map_err(|_| wrong())?;
    if own.is_none() {
        let header = format!("{}.{kind}", path.join("."));
        let text = format!("[{header}]\n{name} = {value}\n");
        let mut made: DocumentMut = text.parse().map_err(|_| wrong())?;
        let item = path
            .iter()
            .try_fold(made.as_item_mut(), |item, key| item.get_mut(*key));
        let item = std::mem::take(item.ok_or_else(wrong)?);
        return match body {
            "frame" => {
                let mut item = item;
                apart(&mut item);
                // A leading comment belongs to the whole file.
                document.insert("frame", item);
                Ok(())
            }
            _ => insert(document, "bodies", body, item),
        };
    }
    let own = path
        .iter()
        .try_fold(document.as_item_mut(), |item, key| item.get_mut(*key));
    let own = own.and_then(Item::as_table_like_mut).ok_or_else(wrong)?;
    if own.get(kind).is_none() {
        let table = match body {
            "frame" => Item::Table(Table::new()),
            _ => Item::Value(toml_edit::InlineTable::new().into()),
        };
        own.insert(kind, table);
    }
    let all = own.get_mut(kind).and_then(Item::as_table_like_mut);
    all.ok_or_else(wrong)?.insert(name, Item::Value(value));
    Ok(())
}
