volatile int n;
ISR(TIMER2_OVF_vect){ n++; }
ISR(PCINT0_vect, ISR_NOBLOCK)
{ n--; }
ISR (INT0_vect) { digitalWrite(13, n); }
EMPTY_INTERRUPT(WDT_vect)
SIGNAL(ADC_vect) { n = 2; }
void setup(){ cli(); sei(); Serial.begin(9600); Serial.println(F("x")); }
void loop(){}
