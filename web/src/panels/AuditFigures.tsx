/** What the audit of a random sample says about the suggestions. */

import type { Audit } from "../api/types";
import { accuracyText } from "../state/audit";

export function AuditFigures({ audit }: { audit: Audit | undefined }) {
  if (audit === undefined || (audit.judged === 0 && audit.unsure === 0)) return null;
  const error = audit.calibration_error;
  return (
    <section class="audit" aria-label="Random audit">
      <h3>Random audit</h3>
      <p>
        {accuracyText(audit)}
        {audit.unsure > 0 && `; ${audit.unsure} unsure, left out`}
      </p>
      {error !== null && (
        <>
          <p>
            Expected calibration error {error.toFixed(3)}, n = {audit.with_confidence}.{" "}
            {audit.calibrated_on > 0
              ? `Written files have confidences of open objects that are calibrated on ${audit.calibrated_on} of these verdicts.`
              : "Written files keep the confidences of the grounder."}
          </p>
          <table>
            <thead>
              <tr>
                <th scope="col">Confidence</th>
                <th scope="col">Mean</th>
                <th scope="col">Right</th>
              </tr>
            </thead>
            <tbody>
              {audit.bins.map(({ lower, upper, count, confidence, accuracy }) => (
                <tr key={lower}>
                  <td>
                    {lower.toFixed(1)} to {upper.toFixed(1)}
                  </td>
                  <td>{confidence.toFixed(2)}</td>
                  <td>
                    {Math.round(accuracy * count)} of {count}
                  </td>
                </tr>
              ))}
            </tbody>
          </table>
        </>
      )}
    </section>
  );
}
