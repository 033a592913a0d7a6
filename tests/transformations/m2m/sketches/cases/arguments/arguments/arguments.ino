// Numbers that mean something else, or have another type, on another core.
void (*restart)() = 0;
void (*later)() = 0;
float level = 2.6;

class Console {
 public:
  Console() { Serial.begin(9600); }
  template <typename T> Console(T speed) { Serial.begin(speed); }
};

Console console;
volatile byte count;

void onEdge() { count++; }

void setup() {
  pinMode(3, INPUT_PULLUP);
  attachInterrupt(1, onEdge, 2);
  later = onEdge;
  for (int pin = 8; pin <= 10; pin++) pinMode(pin, OUTPUT);
}

void loop() {
  int pins[] = {8, 9, 10};
  for (int i = 0; i < 3; i++) digitalWrite(pins[i], i < count);
  Serial.println(round(level));
  int whole = round(level) / 2;
  whole = round(level);
  delay(round(level));
  later();
  volatile uint8_t *out = portOutputRegister(digitalPinToPort(8));
  *out |= digitalPinToBitMask(8);
  uint16_t address = (uint16_t)&level;
  if (count > 200 + whole + address) restart();
}
