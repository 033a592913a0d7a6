void step() {
  digitalWrite(13, HIGH);
  undeclared();
}
