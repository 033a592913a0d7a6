int twice(int x);
int fromModule();
const int pin = 13;

void setup() { pinMode(pin, OUTPUT); }
void loop() { analogWrite(pin, twice(fromModule())); }
