"""Questions to a migration plan: choices, answers, verdicts of elements, adapters, calls that wait for a pin.

`plan` holds the findings and the JSON form of the contract.
Imports `ports`, `circuits` and the modules of `queries`; `reports`, rules, generators and chains may import it.
"""
