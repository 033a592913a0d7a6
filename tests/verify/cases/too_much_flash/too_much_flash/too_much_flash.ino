#define FOUR(x) x, x, x, x
#define KILO(x) FOUR(FOUR(FOUR(FOUR(FOUR(x)))))
#define BLOCK FOUR(KILO(7)), FOUR(KILO(7)), KILO(7), KILO(7)

const uint8_t PROGMEM first[] = {BLOCK};
const uint8_t PROGMEM second[] = {BLOCK};
const uint8_t PROGMEM third[] = {BLOCK};
const uint8_t PROGMEM fourth[] = {BLOCK};

void setup() { pinMode(13, OUTPUT); }

void loop() {
  const unsigned int i = millis() % sizeof first;
  const uint8_t sum = pgm_read_byte(first + i) + pgm_read_byte(second + i) + pgm_read_byte(third + i) + pgm_read_byte(fourth + i);
  digitalWrite(13, sum & 1);
}
