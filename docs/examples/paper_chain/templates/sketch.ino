{# Listing 2 of the paper, and the setup and loop that it omits. -#}
#include "Arduino.h"
{% for header in s.agnosticLibraries %}
#include <{{ header }}>
{% endfor %}
{% for header in headers %}
#include <{{ header }}>
{% endfor %}

{% for port in s.ports %}
const int {{ port.name }} = {{ port.pin }};
{% endfor %}

{% for signature in s.placeholders %}
{{ signature }} {
  // TODO: complete method
}

{% endfor %}
{% for text in s.kept %}
{{ text }}

{% endfor %}
void setup() {
{% for text in s.setup %}
  {{ text }}
{% endfor %}
}

void loop() {
{% for text in s.loop %}
  {{ text }}
{% endfor %}
}
