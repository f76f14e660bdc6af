//! Panel of systems, presets and options, as their rows describe them.

use egui::{DragValue, RichText};
use rasray_experiment::IntegratorSpec;
use rasray_options::{Least, OptionRow, OptionValues, Unit, Value};
use rasray_systems::{Group, SYSTEMS};

use crate::option_controls::Control;
use crate::session::Session;

/// Shows the system with its options.
pub(super) fn show_system(ui: &mut egui::Ui, session: &mut Session) {
    let resolved = session.picture.as_ref().map(|picture| picture.resolved.0.clone()).unwrap_or_default();
    let choice = &mut session.system;
    egui::Grid::new("system").num_columns(2).show(ui, |ui| {
        ui.label("System");
        egui::ComboBox::from_id_salt("system").selected_text(choice.system().name).show_ui(ui, |ui| {
            for system in SYSTEMS {
                let is_chosen = system == choice.system();
                if ui.selectable_label(is_chosen, system.name).on_hover_text(system.doc).clicked() {
                    choice.choose_system(system);
                }
            }
        });
        ui.end_row();
        ui.label("Preset");
        ui.horizontal(|ui| {
            for preset in choice.system().presets {
                let is_chosen = *preset == choice.preset();
                if ui.selectable_label(is_chosen, preset.name()).on_hover_text(preset.doc()).clicked() {
                    choice.choose_preset(*preset);
                }
            }
        });
        ui.end_row();
    });
    let rows = choice.system().options();
    for group in Group::ALL {
        let of_group: Vec<_> =
            rows.iter().filter(|option| option.group == group).map(|option| &option.row).collect();
        if of_group.is_empty() {
            continue;
        }
        let header = format!("Options: {}", group.title());
        show_options(ui, &header, false, &of_group, &mut choice.options, |row| {
            let text =
                |value: &serde_json::Value| value.as_str().map_or_else(|| value.to_string(), str::to_owned);
            row.parse(&resolved.get(row.name).map(text)?).ok()
        });
    }
    if !choice.options.is_empty() && ui.button("Leave all options to the preset").clicked() {
        choice.options = OptionValues::default();
    }
}

/// Shows the options of the integrator.
pub(super) fn show_integrator_options(ui: &mut egui::Ui, session: &mut Session) {
    let integrator = &mut session.frame.integrator;
    let row = integrator.row();
    if row.options.is_empty() {
        return;
    }
    let mut options = integrator.options().clone();
    let header = format!("Options: {}", row.name);
    show_options(ui, &header, true, row.options, &mut options, |row| row.default);
    // Controls give only values that their options accept.
    if let Ok(changed) = IntegratorSpec::new(row, &options) {
        *integrator = changed;
    }
}

/// Shows options under a header with the number of options that are set; `by_default` returns the value of an
/// option that is not set.
fn show_options(
    ui: &mut egui::Ui,
    header: &str,
    is_open: bool,
    rows: &[&OptionRow],
    options: &mut OptionValues,
    by_default: impl Fn(&OptionRow) -> Option<Value>,
) {
    let set = rows.iter().filter(|row| options.get(row.name).is_some()).count();
    let title = if set == 0 { header.to_owned() } else { format!("{header} ({set} set)") };
    egui::CollapsingHeader::new(title).id_salt(header).default_open(is_open).show(ui, |ui| {
        egui::Grid::new(header).num_columns(3).show(ui, |ui| {
            for row in rows {
                show_option(ui, row, options, by_default(row));
                ui.end_row();
            }
        });
    });
}

/// Shows an option: its name, its control, and the button that resets it to its default.
fn show_option(ui: &mut egui::Ui, row: &OptionRow, options: &mut OptionValues, by_default: Option<Value>) {
    let set = options.get(row.name);
    let name = RichText::new(row.name);
    let name = if set.is_some() { name.strong() } else { name };
    ui.label(name).on_hover_text(row.help());
    if let Some(value) = show_control(ui, row, set.or(by_default)) {
        options.set(row.name, value);
    }
    if set.is_some() {
        if ui.small_button("default").on_hover_text("Leave it out").clicked() {
            options.unset(row.name);
        }
    } else {
        ui.label("");
    }
}

/// Shows an option, whose current value may be unknown; returns the value that the user set now.
fn show_control(ui: &mut egui::Ui, row: &OptionRow, value: Option<Value>) -> Option<Value> {
    match Control::of(row) {
        Control::Switch => {
            let mut on = value == Some(Value::Word("on"));
            let word = if value.is_some() { "" } else { "default" };
            ui.checkbox(&mut on, word).changed().then(|| Value::from(if on { "on" } else { "off" }))
        }
        Control::Choice(words) => {
            let (mut chosen, now) = (None, value.and_then(Value::word));
            egui::ComboBox::from_id_salt(row.name)
                .width(110.0)
                .selected_text(now.unwrap_or("default"))
                .show_ui(ui, |ui| {
                    for (word, doc) in words {
                        if ui.selectable_label(now == Some(word), *word).on_hover_text(*doc).clicked() {
                            chosen = Some(Value::Word(word));
                        }
                    }
                });
            chosen
        }
        Control::Whole(lowest, highest) => {
            let mut whole = value.and_then(Value::whole).unwrap_or(lowest);
            let speed = (f64::from(whole) / 100.0).clamp(0.05, 8.0);
            let drag = DragValue::new(&mut whole).range(lowest..=highest).speed(speed);
            ui.add(drag).changed().then_some(Value::Whole(whole))
        }
        Control::Number(unit, least) => {
            let Some(mut number) = value.and_then(Value::number) else {
                return ui.small_button("set").clicked().then_some(Value::Number(1.0));
            };
            let speed = f64::from(number / 100.0).max(1.0e-4);
            let lowest = if least == Least::AboveZero { f32::MIN_POSITIVE } else { 0.0 };
            let drag = DragValue::new(&mut number)
                .range(lowest..=if unit == Unit::Share { 1.0 } else { f32::MAX })
                .speed(speed)
                .max_decimals(6)
                .suffix(if unit == Unit::Metres { " m" } else { "" });
            ui.add(drag).changed().then_some(Value::Number(number))
        }
        Control::Text(hint) => {
            let (id, text) = (ui.id().with(row.name), value.map(|value| value.to_string()));
            let mut typed =
                ui.data_mut(|data| data.get_temp::<String>(id)).or_else(|| text.clone()).unwrap_or_default();
            let response = ui.add(egui::TextEdit::singleline(&mut typed).desired_width(90.0).hint_text(hint));
            if response.lost_focus() {
                ui.data_mut(|data| data.remove::<String>(id));
                // Text that the option does not accept leaves the option unchanged.
                return row.parse(&typed).ok().filter(|typed| Some(*typed) != value);
            }
            if response.changed() {
                ui.data_mut(|data| data.insert_temp(id, typed));
            }
            None
        }
    }
}
