void act(void (*f)(int)) { f(300); }
void on(void (*f)(int), int p) { f(p); }

void setup() {
  on([](int p) { pinMode(p, OUTPUT); }, 6);
  act([](int v) { int wide = v * 200; Serial.println(wide); });
  auto high = [](int p) { digitalWrite(p, HIGH); };
  high(300);
  pinMode(7, OUTPUT);
}

void loop() {}
