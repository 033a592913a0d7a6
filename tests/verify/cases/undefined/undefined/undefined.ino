// set_everything is declared and never defined
void set_everything(int pin);

void setup() {}

void loop() { set_everything(3); }
