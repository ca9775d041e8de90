"""Reports: everything that formats numbers for people and files."""
