"""A demo kitchen in OpenUSD, authored by script: parametric shapes, assets, layout, gold labels."""
