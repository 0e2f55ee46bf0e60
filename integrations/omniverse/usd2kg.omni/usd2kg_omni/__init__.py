"""Extension of Omniverse Kit that labels the open stage with the classes of its objects.

Kit loads `usd2kg_omni.extension`; `usd2kg_omni.core` runs without Kit.
"""
