#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| landform_tests::fuzzing::try_out("png", bytes));
