const int LED = 7;

String name() { return String("lamp"); }

void blink(int pin) {
  digitalWrite(pin, HIGH);
  report(1);
}
