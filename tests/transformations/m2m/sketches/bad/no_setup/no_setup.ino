void loop() {
}
