//! Text of the counts of the lists of a structure's cells.

use rasray_report::{ListRecord, columns, list_rows};
use serde_json::{Value, json};

pub(super) fn lists_json(lists: &[ListRecord]) -> Value {
    json!({ "lists": lists })
}

pub(super) fn lists_text(lists: &[ListRecord]) -> String {
    if lists.is_empty() {
        return "the cells of this structure have no lists that are counted\n".to_owned();
    }
    columns(&list_rows(lists), 1)
}
