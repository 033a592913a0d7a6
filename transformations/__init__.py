"""The content: readers, transformations, generators and chains, one file each, found by the framework through `registry`.

No framework code lives here. What is offered is a table of names and `module:attribute` texts; nothing is imported
before it is asked for.
"""

from __future__ import annotations

from robosmi.plugins import Registry

_CONTENT = {
    ("program reader", "c_source"): "t2m.c_source:read_program",
    ("drawing reader", "eagle"): "t2m.eagle:read_circuit",
    ("drawing reader", "fritzing"): "t2m.fritzing:read_circuit",
    ("drawing reader", "kicad"): "t2m.kicad:read_circuit",
    ("drawing reader", "pin_table"): "t2m.pin_table:read_circuit",
    ("drawing reader", "wokwi"): "t2m.wokwi:read_circuit",
    ("drawing recogniser", "eagle"): "t2m.eagle.reader:recognises",
    ("drawing recogniser", "fritzing"): "t2m.fritzing.container:recognises",
    ("drawing recogniser", "kicad"): "t2m.kicad.reader:recognises",
    ("drawing recogniser", "pin_table"): "t2m.pin_table:recognises",
    ("drawing recogniser", "wokwi"): "t2m.wokwi.document:recognises",
    ("parts reader", "fritzing"): "t2m.fritzing.part_library:read_library",
    ("ranker", "devices"): "knowledge.libraries.library_ranking:device_ranker",
    ("ranker", "tfidf"): "knowledge.libraries.library_ranking:tfidf_ranker",
    ("generator", "arduino_sketch"): "m2t.arduino_sketch:generate",
    ("generator", "avr_c_program"): "m2t.avr_c_program:generate",
    ("chain", "analyse"): "chains.analyse:analyse",
    ("chain", "hardware"): "chains.hardware:hardware",
    ("chain", "adapters_list"): "chains.adapters:list_adapters",
    ("chain", "adapters_save"): "chains.adapters:save_adapters",
    ("chain", "adapters_show"): "chains.adapters:show_adapter",
    ("chain", "parts_import"): "chains.parts:import_parts",
    ("chain", "history_export"): "chains.history:export_history",
    ("chain", "history_import"): "chains.history:import_history",
    ("chain", "libraries_import"): "chains.libraries:import_libraries",
    ("chain", "libraries_pin"): "chains.libraries:pin_library",
    ("chain", "libraries_show"): "chains.libraries:show_library",
    ("chain", "platform_import"): "chains.platform:import_platform",
    ("chain", "recommend"): "chains.recommend:recommend",
    ("chain", "migrate"): "chains.move:migrate_or_move",
    ("chain", "plan"): "chains.migrate:plan_migration",
    ("chain", "choose"): "chains.choose:choose",
    ("chain", "generate"): "chains.generate:generate",
    ("chain", "page"): "chains.page:PlanPage",
    ("chain", "editor"): "chains.editing.editor:Editor",
    ("chain", "report_page"): "chains.page:report_page",
    ("chain", "check"): "chains.check:check",
    ("chain", "corpus_programs"): "chains.corpus:programs",
    ("chain", "corpus_files"): "chains.corpus:files",
    ("chain", "corpus_settings"): "chains.corpus:check_settings",
    ("chain", "corpus_analyse"): "chains.corpus:analyse_step",
    ("chain", "corpus_migrate"): "chains.corpus:migrate_step",
    ("chain", "corpus_compile"): "chains.corpus:compile_step",
    ("chain", "corpus_verify"): "chains.corpus:verify_step",
    ("chain", "targets"): "chains.targets:targets",
    ("chain", "simulate"): "chains.simulate:simulate",
    ("chain", "verify"): "chains.verify:verify",
    ("chain", "watch"): "chains.watch:WatchedFolder",
    ("chain", "output_diff"): "chains.output_diff:output_diff",
    ("chain", "wiring"): "chains.wiring:wiring",
    ("chain", "with_verdict"): "chains.verify:with_verdict",
    ("query", "boards_to_compile_for"): "knowledge.compile_boards:boards_to_compile_for",
    ("query", "core_properties"): "knowledge.cores.installed_board:core_properties",
    ("query", "installed_board"): "knowledge.cores.installed_board:installed_board",
    ("query", "default_library_platform"): "knowledge.libraries.library_ranking:default_library_platform",
    ("query", "stack_bound"): "verification.stack.machine_stack:stack_bound",
    ("query", "libraries_by_header"): "knowledge.libraries.library_ranking:libraries_by_header",
    ("query", "migration_project"): "chains.move:project_for",
    ("query", "upload_refusals"): "chains.check:upload_refusals",
    ("named query", "boards"): "queries.circuits.circuit:boards",
    ("named query", "component_named"): "queries.circuits.circuit:component_named",
    ("named query", "disposition_counts"): "queries.plans.plan:disposition_counts",
    ("named query", "free_pins"): "queries.plans.choices:free_pins",
    ("named query", "open_choices"): "queries.plans.plan:open_choices",
    ("named query", "user_calls"): "queries.code:user_calls",
    ("constraints", "ccode"): "constraints.code:code",
    ("constraints", "hardware"): "constraints.hardware:circuit",
    ("constraints", "migration"): "constraints.plan:plan",
    ("wiring form", "csv"): "chains.wiring:csv",
    ("wiring form", "svg"): "chains.wiring:picture",
    ("wiring form", "wokwi"): "chains.wiring:wokwi",
    ("view", "http://robosmi.org/hardware/1#Circuit"): "m2t.notebook_views:circuit_html",
    ("view", "http://robosmi.org/migration/2#MigrationPlan"): "m2t.notebook_views:plan_html",
    ("engine", "simavr"): "verification.engines.simavr:Simavr",
    ("engine", "avr8js"): "verification.engines.avr8js:Avr8js",
    ("engine", "rp2040js"): "verification.engines.rp2040js:Rp2040js",
    ("engine", "api"): "verification.engines.api:Api",
    ("device", "answering_line"): "verification.devices.serial_line:AnsweringLine",
    ("device", "capacitor"): "verification.devices.capacitor:Capacitor",
    ("device", "dht22"): "verification.devices.dht22:Dht22",
    ("device", "eeprom"): "verification.devices.two_wire:Eeprom",
    ("device", "keypad"): "verification.devices.keypad:Keypad",
    ("device", "levels"): "verification.devices.levels:Levels",
    ("device", "light_chain"): "verification.devices.light_chain:LightChain",
    ("device", "ranger"): "verification.devices.ranger:Ranger",
    ("device", "motor_wheel"): "verification.devices.motor_wheel:MotorWheel",
    ("device", "registers"): "verification.devices.two_wire:Registers",
    ("device", "serial_line"): "verification.devices.serial_line:SerialLine",
    ("device", "feedback_servo"): "verification.devices.feedback_servo:FeedbackServo",
    ("device", "lis3dh"): "verification.devices.lis3dh:Lis3dh",
    ("device", "bme680"): "verification.devices.bme680:Bme680",
    ("device", "serial_registers"): "verification.devices.serial_registers:SerialRegisters",
    ("device", "shifted_bits"): "verification.devices.shifted_bits:ShiftedBits",
    ("device", "sony_remote"): "verification.devices.infrared:SonyRemote",
    ("device", "two_pin_ranger"): "verification.devices.ranger:TwoPinRanger",
    ("device", "stored_bytes"): "verification.devices.two_wire:StoredBytes",
    ("device", "typing"): "verification.devices.levels:Typing",
    ("device", "voltages"): "verification.devices.levels:Voltages",
    ("device", "wheel"): "verification.devices.wheel:Wheel",
}


_DRIVERS = {
    "c": "robosmi.transformations.t2m.c_source.on_demand:open_program",
    **dict.fromkeys(
        (".c", ".cc", ".cpp", ".cxx", ".h", ".hpp", ".ino"), "robosmi.transformations.t2m.c_source.on_demand:open_program"
    ),
    **dict.fromkeys(("platform", "/platform.toml"), "robosmi.transformations.knowledge.platforms.platform_driver:open_platform"),
    **dict.fromkeys((".fz", ".fzp"), "robosmi.model.plain_xml:open_xml"),
    **dict.fromkeys(("fritzing", ".fzz"), "robosmi.transformations.t2m.fritzing.drawing_model:open_drawing"),
}
"""Drivers of models by name, by the endings of the files that they open, and by the file that marks a folder."""


def registry(target: Registry) -> None:
    """Offer everything of this package (the value of its entry point)."""
    for (kind, name), place in _CONTENT.items():
        target.add(kind, name, f"robosmi.transformations.{place}")
    for name, place in _DRIVERS.items():
        target.add("driver", name, place)
