//! Systems, presets and options, as the registry says them.

use std::collections::BTreeMap;

use egui::{DragValue, RichText};
use rasray_systems::{Group, OptionRow, SYSTEMS};
use serde_json::Value;

use crate::option_controls::{Control, OptionValues};
use crate::session::Session;

/// Shows the system with its options.
pub(super) fn show_system(ui: &mut egui::Ui, session: &mut Session) {
    let resolved = session.picture.as_ref().map(|picture| picture.resolved.0.clone()).unwrap_or_default();
    let options = &mut session.options;
    egui::Grid::new("system").num_columns(2).show(ui, |ui| {
        ui.label("System");
        egui::ComboBox::from_id_salt("system").selected_text(options.system().name).show_ui(ui, |ui| {
            for system in SYSTEMS {
                let is_chosen = system == options.system();
                if ui.selectable_label(is_chosen, system.name).on_hover_text(system.doc).clicked() {
                    options.choose_system(system);
                }
            }
        });
        ui.end_row();
        ui.label("Preset");
        ui.horizontal(|ui| {
            for preset in options.system().presets {
                let is_chosen = *preset == options.preset();
                if ui.selectable_label(is_chosen, preset.name()).on_hover_text(preset.doc()).clicked() {
                    options.choose_preset(*preset);
                }
            }
        });
        ui.end_row();
    });
    let rows = options.system().options();
    for group in Group::ALL {
        let of_group: Vec<_> = rows.iter().filter(|row| row.group == group).collect();
        if of_group.is_empty() {
            continue;
        }
        let set = of_group.iter().filter(|row| options.text(row.name).is_some()).count();
        let title = match set {
            0 => format!("Options: {}", group.title()),
            set => format!("Options: {} ({set} set)", group.title()),
        };
        egui::CollapsingHeader::new(title).id_salt(group.title()).show(ui, |ui| {
            egui::Grid::new(group.title()).num_columns(3).show(ui, |ui| {
                for row in of_group {
                    show_option(ui, row, options, &resolved);
                    ui.end_row();
                }
            });
        });
    }
    if options.any_set() && ui.button("Leave all options to the preset").clicked() {
        options.unset_all();
    }
}

/// An option: its name, what sets it, and what leaves it to the preset.
fn show_option(
    ui: &mut egui::Ui,
    row: &OptionRow,
    options: &mut OptionValues,
    resolved: &BTreeMap<String, Value>,
) {
    let set = options.text(row.name);
    let name = RichText::new(row.name);
    let name = if set.is_some() { name.strong() } else { name };
    ui.label(name).on_hover_text(row.doc);
    let in_force = set.clone().or_else(|| {
        let value = resolved.get(row.name)?;
        Some(value.as_str().map_or_else(|| value.to_string(), str::to_owned))
    });
    if let Some(value) = show_control(ui, row, in_force.as_deref()) {
        options.set(row.name, value);
    }
    if set.is_some() {
        if ui.small_button("preset").on_hover_text("Leave it to the preset").clicked() {
            options.unset(row.name);
        }
    } else {
        ui.label("");
    }
}

/// What sets an option whose value in force is `text`; the value that it was set to now.
fn show_control(ui: &mut egui::Ui, row: &OptionRow, text: Option<&str>) -> Option<Value> {
    match Control::of(row) {
        Control::Switch => {
            let mut on = text == Some("on");
            let word = if text.is_some() { "" } else { "as the preset says" };
            ui.checkbox(&mut on, word).changed().then(|| Value::from(if on { "on" } else { "off" }))
        }
        Control::Choice(words) => {
            let mut chosen = None;
            egui::ComboBox::from_id_salt(row.name)
                .width(110.0)
                .selected_text(text.unwrap_or("preset"))
                .show_ui(ui, |ui| {
                    for (word, doc) in words {
                        if ui.selectable_label(text == Some(word), *word).on_hover_text(*doc).clicked() {
                            chosen = Some(Value::from(*word));
                        }
                    }
                });
            chosen
        }
        Control::Whole(lowest, highest) => {
            let mut number: u32 = text.and_then(|text| text.parse().ok()).unwrap_or(lowest);
            let speed = (f64::from(number) / 100.0).clamp(0.05, 8.0);
            let drag = DragValue::new(&mut number).range(lowest..=highest).speed(speed);
            ui.add(drag).changed().then(|| Value::from(number))
        }
        Control::Number(unit) => {
            let mut number: f64 = text.and_then(|text| text.parse().ok()).unwrap_or(0.0);
            let speed = (number / 100.0).max(1.0e-4);
            let drag = DragValue::new(&mut number)
                .range(0.0..=f64::from(f32::MAX))
                .speed(speed)
                .max_decimals(6)
                .suffix(format!(" {unit}"));
            ui.add(drag).changed().then(|| Value::from(number))
        }
        Control::Cells => {
            let id = ui.id().with(row.name);
            let mut typed = ui
                .data_mut(|data| data.get_temp::<String>(id))
                .or(text.map(str::to_owned))
                .unwrap_or_default();
            let response =
                ui.add(egui::TextEdit::singleline(&mut typed).desired_width(90.0).hint_text("WxH"));
            if response.lost_focus() {
                ui.data_mut(|data| data.remove::<String>(id));
                return (Some(typed.as_str()) != text && !typed.is_empty()).then(|| Value::from(typed));
            }
            if response.changed() {
                ui.data_mut(|data| data.insert_temp(id, typed));
            }
            None
        }
    }
}
